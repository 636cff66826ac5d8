#include "run/manifest.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

constexpr int manifest_version = 7;  // 7: the building's hierarchy

/// JSON has no infinity (the error of a link that nothing is known about yet): the largest number
/// stands for it.
std::vector<double> finite(std::vector<double> numbers) {
  for (double& x : numbers) {
    if (!std::isfinite(x)) x = std::copysign(std::numeric_limits<double>::max(), x);
  }
  return numbers;
}

}  // namespace

std::optional<Manifest> read_manifest(const RunLayout& layout) {
  const std::string path = layout.manifest();
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::vector<std::byte> bytes = read_file(path);
  try {
    const auto json =
        nlohmann::json::parse(reinterpret_cast<const char*>(bytes.data()),
                              reinterpret_cast<const char*>(bytes.data() + bytes.size()));
    if (json.at("format") != "enfilade-manifest") {
      throw RunError(path + ": not a manifest; solve again without --resume");
    }
    if (json.at("version") != manifest_version) {
      throw RunError(path + ": the run is of another version of enfilade (" +
                     json.at("version").dump() + ", this one knows " +
                     std::to_string(manifest_version) + "); solve again without --resume");
    }
    Manifest m;
    m.iteration = json.at("iteration");
    m.clusters = json.at("clusters");
    m.basis = json.at("basis") == "linear" ? Basis::linear : Basis::constant;
    m.hierarchy = json.at("hierarchy") == "building" ? Hierarchy::building : Hierarchy::clusters;
    m.scene_hash = hash_from_text(json.at("scene_hash").get<std::string>());
    m.finished = json.at("finished");
    m.history = json.at("history").get<std::vector<std::vector<double>>>();
    m.correction = json.at("correction").get<std::vector<double>>();
    m.unknowns.first = json.at("first_unknown").get<std::vector<std::uint32_t>>();
    m.unknowns.aggregates = json.at("aggregates").get<std::vector<std::uint32_t>>();
    if (!m.correction.empty() && !m.unknowns.complete(m.clusters, m.correction.size())) {
      throw RunError(path + ": damaged; solve again without --resume");
    }
    return m;
  } catch (const nlohmann::json::exception&) {
    throw RunError(path + ": damaged; solve again without --resume");
  } catch (const std::logic_error&) {
    throw RunError(path + ": damaged; solve again without --resume");
  }
}

void commit_manifest(const RunLayout& layout, const Manifest& m) {
  std::vector<std::vector<double>> history;
  for (const auto& numbers : m.history) history.push_back(finite(numbers));
  const nlohmann::ordered_json json = {{"format", "enfilade-manifest"},
                                       {"version", manifest_version},
                                       {"iteration", m.iteration},
                                       {"clusters", m.clusters},
                                       {"basis", m.basis == Basis::linear ? "linear" : "constant"},
                                       {"hierarchy", name_of(m.hierarchy)},
                                       {"scene_hash", hash_text(m.scene_hash)},
                                       {"finished", m.finished},
                                       {"history", history},
                                       {"correction", finite(m.correction)},
                                       {"first_unknown", m.unknowns.first},
                                       {"aggregates", m.unknowns.aggregates}};
  // An iteration under way must outlive the death of its processes, which the page cache does; a
  // finished run must outlive the machine's as well.
  if (m.finished) flush_to_disk(layout.common());
  replace_file(layout.manifest(), json.dump() + "\n");
  if (m.finished) flush_to_disk(layout.common());
}

void remove_manifest(const RunLayout& layout) {
  std::error_code code;
  std::filesystem::remove(layout.manifest(), code);
  if (code)
    throw RunError(layout.manifest() + ": cannot be removed: " + code.message() +
                   "; see to its permissions");
}

}  // namespace enfilade
