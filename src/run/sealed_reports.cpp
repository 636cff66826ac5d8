#include "run/sealed_reports.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/posix_file.hpp"
#include "json/sealed_json.hpp"
#include "run/manifest.hpp"

namespace enfilade {
namespace {

constexpr const char* reports_remedy = "make the reports again with 'enfilade solve RUN --resume'";
constexpr SealedFormat reports_format{"enfilade-reports", 1, reports_remedy};
constexpr std::array names = {"stats.json", "history.json", "warnings.json", "assignment.json",
                              "pictures/ranks.svg"};

std::string seal_path(const std::string& run_directory) { return run_directory + "/reports.json"; }

bool exists(const std::string& path) {
  std::error_code code;
  return std::filesystem::exists(path, code);
}

std::string text_of(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

[[noreturn]] void refuse_report(const std::string& path, const std::string& what) {
  throw RunError(path + ": " + what + "; " + reports_remedy);
}

struct Seal {
  std::uint64_t run = 0;
  int iteration = 0;
  std::map<std::string, std::uint64_t> sums;
};

Seal read_seal(const std::string& run_directory) {
  const std::string path = seal_path(run_directory);
  if (!exists(path)) return {};
  Seal seal;
  unseal(reports_format, text_of(path), path, [&seal](const nlohmann::ordered_json& json) {
    seal.run = hash_from_text(json.at("run"));
    seal.iteration = whole<int>(json.at("iteration"));
    for (const auto& [name, sum] : json.at("files").items()) seal.sums[name] = hash_from_text(sum);
  });
  const std::optional<Manifest> manifest = read_manifest(RunLayout(run_directory));
  if (!manifest || manifest->run != seal.run || manifest->iteration != seal.iteration)
    refuse_report(path, "is of another run, or of another iteration than the committed one");
  return seal;
}

}  // namespace

void seal_reports(const std::string& run_directory, std::span<const std::string> more) {
  const Manifest manifest = committed_manifest(RunLayout(run_directory));
  nlohmann::ordered_json files = nlohmann::ordered_json::object();
  std::vector<std::string> all(names.begin(), names.end());
  all.insert(all.end(), more.begin(), more.end());
  for (const std::string& name : all) {
    const std::string path = run_directory + "/" + name;
    if (exists(path)) files[name] = hash_text(checksum(text_of(path)));
  }
  write_file_atomically(seal_path(run_directory),
                        seal(reports_format, {{"run", hash_text(manifest.run)},
                                              {"iteration", manifest.iteration},
                                              {"files", files}}));
}

bool reports_are_whole(const std::string& run_directory, std::span<const std::string> named) {
  try {
    const Seal seal = read_seal(run_directory);
    return std::ranges::all_of(named,
                               [&](const std::string& name) { return seal.sums.contains(name); }) &&
           std::ranges::all_of(seal.sums, [&](const auto& entry) {
             const std::string path = run_directory + "/" + entry.first;
             return exists(path) && checksum(text_of(path)) == entry.second;
           });
  } catch (const RunError&) {
    return false;
  }
}

std::optional<std::string> read_report(const std::string& run_directory, const std::string& name) {
  const std::string path = run_directory + "/" + name;
  const Seal seal = read_seal(run_directory);
  const auto known = seal.sums.find(name);
  if (!exists(path)) {
    if (known != seal.sums.end()) refuse_report(path, "is missing");
    return std::nullopt;
  }
  std::string text = text_of(path);
  if (known == seal.sums.end()) refuse_report(path, "is not in reports.json");
  if (known->second != checksum(text)) refuse_report(path, "was changed since the solve wrote it");
  return text;
}

}  // namespace enfilade
