#include "run/manifest.hpp"

#include <cmath>
#include <filesystem>
#include <limits>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/posix_file.hpp"
#include "json/sealed_json.hpp"
#include "run/run_mark.hpp"

namespace enfilade {
namespace {

constexpr SealedFormat manifest_format{"enfilade-manifest", manifest_version,
                                       "solve again without --resume"};

/// JSON has no infinity (the error of a link that nothing is known about yet): the largest number
/// stands for it.
std::vector<double> finite(std::vector<double> numbers) {
  for (double& x : numbers) {
    if (!std::isfinite(x)) x = std::copysign(std::numeric_limits<double>::max(), x);
  }
  return numbers;
}

Manifest manifest_from(const nlohmann::ordered_json& json) {
  Manifest m;
  m.iteration = whole<int>(json.at("iteration"));
  m.clusters = whole<std::size_t>(json.at("clusters"));
  m.ranks = whole<int>(json.at("ranks"));
  m.basis = json.at("basis") == "linear" ? Basis::linear : Basis::constant;
  m.hierarchy = json.at("hierarchy") == "building" ? Hierarchy::building : Hierarchy::clusters;
  m.scene_hash = hash_from_text(json.at("scene_hash").get<std::string>());
  m.preparation = hash_from_text(json.at("preparation").get<std::string>());
  m.run = hash_from_text(json.at("run").get<std::string>());
  m.finished = json.at("finished");
  m.history = json.at("history").get<std::vector<std::vector<double>>>();
  m.correction = json.at("correction").get<std::vector<double>>();
  m.unknowns.first = whole_list<std::uint32_t>(json.at("first_unknown"));
  m.unknowns.aggregates = whole_list<std::uint32_t>(json.at("aggregates"));
  if (!m.correction.empty() && !m.unknowns.complete(m.clusters, m.correction.size())) {
    throw RunError("damaged (the correction is of other clusters)");
  }
  if (m.iteration < 0 || static_cast<std::size_t>(m.iteration) != m.history.size()) {
    throw RunError("damaged (the history is of another iteration)");
  }
  return m;
}

}  // namespace

std::optional<Manifest> read_manifest(const RunLayout& layout) {
  const std::string path = layout.manifest();
  if (!std::filesystem::exists(path)) return std::nullopt;
  const std::vector<std::byte> bytes = read_file(path);
  std::optional<Manifest> manifest;
  unseal(manifest_format, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path,
         [&manifest](const nlohmann::ordered_json& json) { manifest = manifest_from(json); });
  return manifest;
}

Manifest committed_manifest(const RunLayout& layout) {
  const std::optional<Manifest> manifest = read_manifest(layout);
  if (!manifest) {
    throw InputError(layout.run, "solution", "there is none", "run 'enfilade solve' on it first");
  }
  const std::optional<RunMark> mark = read_run_mark(layout.run);
  if (!mark || manifest->preparation != mark->preparation()) {
    throw RunError(layout.manifest() + ": is of another run; solve again without --resume");
  }
  return *manifest;
}

void commit_manifest(const RunLayout& layout, const Manifest& m) {
  std::vector<std::vector<double>> history;
  for (const auto& numbers : m.history) history.push_back(finite(numbers));
  const nlohmann::ordered_json json = {{"iteration", m.iteration},
                                       {"clusters", m.clusters},
                                       {"ranks", m.ranks},
                                       {"basis", m.basis == Basis::linear ? "linear" : "constant"},
                                       {"hierarchy", name_of(m.hierarchy)},
                                       {"scene_hash", hash_text(m.scene_hash)},
                                       {"preparation", hash_text(m.preparation)},
                                       {"run", hash_text(m.run)},
                                       {"finished", m.finished},
                                       {"history", history},
                                       {"correction", finite(m.correction)},
                                       {"first_unknown", m.unknowns.first},
                                       {"aggregates", m.unknowns.aggregates}};
  // An iteration under way must outlive the death of its processes, which the page cache does; a
  // finished run must outlive the machine's as well.
  if (m.finished) flush_to_disk(layout.common());
  replace_file(layout.manifest(), seal(manifest_format, json));
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
