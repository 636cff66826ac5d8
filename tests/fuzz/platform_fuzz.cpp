// The properties of a simulated platform's hosts and disks: any words give numbers that a
// simulation can go on with, or an InputError. Each line is "key value".
#include <cmath>
#include <sstream>

#include "base/error.hpp"
#include "fuzz_target.hpp"
#include "machine/platform_properties.hpp"

namespace enfilade {
namespace {

/// Requests end, and none ends before it could on an idle disk.
void check_requests(const BackgroundLoad& load) {
  for (const double start_s : {0.0, 0.7, 86400.0, 1e9}) {
    for (const double seconds : {0.0, 1e-6, 3.0, 1e5}) {
      const double end_s = load.end_s(start_s, seconds);
      fuzz::require(std::isfinite(end_s) && end_s >= (start_s + seconds) * (1.0 - 1e-12));
    }
  }
}

}  // namespace
}  // namespace enfilade

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  PlatformProperties properties;
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = line.find(' ');
    properties[line.substr(0, blank)] = blank == std::string::npos ? "" : line.substr(blank + 1);
  }
  try {
    fuzz::require(host_properties("h", properties).memory_bytes <= std::uint64_t{1} << 62);
  } catch (const InputError&) {
  }
  try {
    const DiskProperties disk = disk_properties("d", properties);
    for (const auto& seconds : {disk.seek_s, disk.request_s})
      fuzz::require(!seconds || (std::isfinite(*seconds) && *seconds >= 0.0));
    check_requests(disk.background);
  } catch (const InputError&) {
  }
  return 0;
}
