#include "machine/platform_properties.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "base/error.hpp"
#include "base/nearest_word.hpp"
#include "machine/cost_model.hpp"

namespace enfilade {
namespace {

const std::vector<std::string> of_hosts{"memory", "serves"};
const std::vector<std::string> of_disks{"background", "request_s", "seek_s"};

/// Refuses a property whose name is nearly one of `ours`, or is one of `others`, which belong
/// elsewhere.
void refuse_misspelt(const PlatformProperties& properties, const std::string& of,
                     const std::vector<std::string>& ours, const std::string& others_place,
                     const std::vector<std::string>& others) {
  for (const auto& [key, value] : properties) {
    if (std::find(ours.begin(), ours.end(), key) != ours.end()) continue;
    const std::string place = of + ": " + key;
    if (std::find(others.begin(), others.end(), key) != others.end()) {
      throw InputError("platform", place, "no such property here", "put it into " + others_place);
    }
    const std::string meant = nearest_word(key, ours);
    if (meant.empty()) continue;
    throw InputError("platform", place, "no such property", "did you mean '" + meant + "'?");
  }
}

const std::string* value_of(const PlatformProperties& properties, const char* key) {
  const auto found = properties.find(key);
  return found == properties.end() ? nullptr : &found->second;
}

std::optional<double> seconds_of(const PlatformProperties& properties, const std::string& of,
                                 const char* key) {
  const std::string* text = value_of(properties, key);
  if (text == nullptr) return std::nullopt;
  char* end = nullptr;
  const double seconds = std::strtod(text->c_str(), &end);
  const bool whole = !text->empty() && end == text->c_str() + text->size();
  if (whole && seconds >= 0.0 && std::isfinite(seconds)) return seconds;
  throw InputError("platform", of + ": " + key,
                   "'" + *text + "' is not a number of seconds from 0 up",
                   "give it as platforms/README.md shows");
}

}  // namespace

HostProperties host_properties(const std::string& host, const PlatformProperties& properties) {
  const std::string of = "host " + host;
  refuse_misspelt(properties, of, of_hosts, "the host's <disk>", of_disks);
  HostProperties read;
  if (const std::string* serves = value_of(properties, "serves")) {
    if (*serves != "common" && *serves != "alone") {
      throw InputError("platform", of + ": serves", "'" + *serves + "' is neither common nor alone",
                       "give it as platforms/README.md shows");
    }
    read.serves = *serves == "common" ? Serves::common : Serves::alone;
  }
  if (const std::string* memory = value_of(properties, "memory"))
    read.memory_bytes = parse_bytes(*memory, "platform", of + ": memory");
  return read;
}

DiskProperties disk_properties(const std::string& disk, const PlatformProperties& properties) {
  const std::string of = "disk " + disk;
  refuse_misspelt(properties, of, of_disks, "the <host>", of_hosts);
  DiskProperties read;
  read.seek_s = seconds_of(properties, of, "seek_s");
  read.request_s = seconds_of(properties, of, "request_s");
  if (const std::string* others = value_of(properties, "background"))
    read.background = BackgroundLoad(*others, "platform", of + ": background");
  return read;
}

}  // namespace enfilade
