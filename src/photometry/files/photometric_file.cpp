#include "photometry/files/photometric_file.hpp"

#include <algorithm>

#include "base/limits.hpp"
#include "photometry/files/eulumdat_reader.hpp"
#include "photometry/files/ies_reader.hpp"

namespace enfilade {
namespace {

std::string ending_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  std::string ending = dot == std::string::npos ? "" : path.substr(dot);
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

/// LM-63 files begin with "IES", or have a TILT line; EULUMDAT files have neither.
bool looks_like_ies(const std::vector<std::string>& lines) {
  return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.rfind("TILT", 0) == 0 || (&line == &lines[0] && line.rfind("IES", 0) == 0);
  });
}

}  // namespace

double LampTilt::factor(double at) const {
  if (degrees.empty()) return 1.0;
  if (at <= degrees.front()) return factors.front();
  if (at >= degrees.back()) return factors.back();
  const auto above = std::upper_bound(degrees.begin(), degrees.end(), at);
  const auto i = static_cast<std::size_t>(above - degrees.begin());
  const double share = (at - degrees[i - 1]) / (degrees[i] - degrees[i - 1]);
  return factors[i - 1] + share * (factors[i] - factors[i - 1]);
}

bool is_photometric_file(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".ies" || ending == ".ldt";
}

PhotometricFile read_photometric_file(const std::string& bytes, const std::string& path,
                                      Warnings& warnings, const SideFile& beside) {
  PhotometricReport report(path, warnings);
  const std::vector<std::string> lines = lines_of(photometric_text(bytes, report));
  const bool ies = looks_like_ies(lines), by_ending = ending_of(path) == ".ies";
  if (ies && !by_ending && ending_of(path) == ".ldt")
    report.warn("is an IES file (LM-63) by its text: read so");
  PhotometricFile file =
      ies || by_ending ? read_ies(lines, beside, report) : read_eulumdat(lines, report);
  if (const auto fault = limits::fault_of_opening(file.opening.size))
    report.fail("the luminous opening", fault.what, "correct the file, or get it again");
  return file;
}

}  // namespace enfilade
