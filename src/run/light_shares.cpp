#include "run/light_shares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/posix_file.hpp"
#include "json/sealed_json.hpp"
#include "shares/share_scene.hpp"

namespace enfilade {
namespace {

constexpr const char* shares_remedy =
    "find the shares again with 'enfilade solve RUN --resume --shares'";
constexpr SealedFormat index_format{"enfilade-shares", 2, shares_remedy};

std::string directory_of(const std::string& run_directory) { return run_directory + "/shares"; }

std::string index_path(const std::string& run_directory) {
  return directory_of(run_directory) + "/shares.json";
}

/// Names the shares of a run in their files: a file of other groups is refused.
std::uint64_t name_of_shares(const Manifest& manifest, const ShareIndex& index) {
  ByteWriter w;
  w.put(manifest.run);
  w.put(static_cast<std::uint64_t>(index.per_file));
  for (const std::string& name : index.names) w.put_text(name);
  return checksum(w.bytes());
}

/// The files of the shares from group `first` on.
SegmentKind kind_of(const Manifest& manifest, const ShareIndex& index, std::size_t first) {
  return {"shares-" + std::to_string(first / index.per_file), Section::patches,
          static_cast<std::uint32_t>(manifest.iteration), name_of_shares(manifest, index)};
}

ShareIndex index_from(const nlohmann::ordered_json& json) {
  ShareIndex index;
  index.names = json.at("names").get<std::vector<std::string>>();
  index.per_file = whole<std::size_t>(json.at("per_file"));
  index.ranks = whole<int>(json.at("ranks"));
  index.iterations = whole<int>(json.at("iterations"));
  index.converged = json.at("converged");
  index.difference = json.at("difference");
  index.solve_s = json.at("solve_s");
  if (index.names.empty() || index.per_file == 0) throw RunError("damaged (it names no shares)");
  return index;
}

/// What is wrong with the files is mended by finding the shares again.
template <class Read>
auto with_remedy(const Read& read) {
  try {
    return read();
  } catch (const RunError& error) {
    const std::string what = error.what();
    throw RunError(what.substr(0, what.rfind("; ")) + "; " + shares_remedy);
  }
}

/// All files of shares, by their number.
std::vector<SegmentIndex> share_segments(const std::string& run_directory, const Manifest& manifest,
                                         const ShareIndex& index) {
  std::vector<SegmentIndex> segments;
  for (std::size_t first = 0; first < index.names.size(); first += index.per_file)
    segments.emplace_back(directory_of(run_directory), kind_of(manifest, index, first),
                          manifest.clusters, index.ranks);
  return segments;
}

/// Reads the irradiance of a cluster's leaves by all shares into the bands after the lead bands.
void read_leaves(std::span<const SegmentIndex> segments, const ShareIndex& index,
                 ClusterState& wide) {
  PatchForest& patches = wide.patches();
  const auto lead = static_cast<std::size_t>(patches.lead_bands() * patches.terms());
  const std::size_t shares = index.names.size();
  for (std::size_t number = 0; number < segments.size(); ++number) {
    const std::size_t first = number * index.per_file;
    const SectionFile file = segments[number].read(wide.id());
    ByteReader reader(file.bytes, "shares");
    const std::vector<float> values = reader.get_all<float>();
    const std::size_t width = std::min(index.per_file, shares - first) * lead;
    std::size_t at = 0;
    for (std::size_t n = 0; n < patches.size() && at + width <= values.size(); ++n) {
      if (!patches.node(n).leaf()) continue;
      double* to = patches.irradiance(n).data() + (1 + first) * lead;
      for (std::size_t i = 0; i < width; ++i) to[i] = values[at++];
    }
    if (at != values.size() || (patches.size() + patches.polygons()) / 2 * width != at) {
      throw RunError("shares of cluster " + std::to_string(wide.id().value) +
                     ": are of other patches; " + shares_remedy);
    }
  }
}

/// Makes the shares at a leaf sum to its whole irradiance: what the solve's own iterations left out
/// goes to each share by its part of the light there.
void complete_leaf(std::span<double> irradiance, std::size_t lead, std::size_t terms) {
  const std::size_t shares = irradiance.size() / lead - 1;
  for (std::size_t band = 0; band < lead; band += terms) {
    double light = 0.0;
    for (std::size_t i = 1; i <= shares; ++i) light += std::abs(irradiance[i * lead + band]);
    std::array<double, 3> missing{};
    for (std::size_t t = 0; t < terms; ++t) {
      missing[t] = irradiance[band + t];
      for (std::size_t i = 1; i <= shares; ++i) missing[t] -= irradiance[i * lead + band + t];
    }
    for (std::size_t i = 1; i <= shares; ++i) {
      double* share = irradiance.data() + i * lead + band;
      const double part =
          light > 0.0 ? std::abs(share[0]) / light : 1.0 / static_cast<double>(shares);
      for (std::size_t t = 0; t < terms; ++t) share[t] += part * missing[t];
    }
  }
}

/// Copies the irradiance of the leaves, as far as `to` has its bands.
void copy_leaves(const PatchForest& from, PatchForest& to) {
  for (std::size_t n = 0; n < from.size(); ++n) {
    const std::span<const double> light = from.irradiance(n);
    if (from.node(n).leaf()) std::copy(light.begin(), light.end(), to.irradiance(n).begin());
  }
}

}  // namespace

ShareWriter::ShareWriter(const std::string& run_directory, const Manifest& manifest,
                         const ShareIndex& index, std::size_t first, Rank rank)
    : segment_(directory_of(run_directory), kind_of(manifest, index, first), rank) {}

void ShareWriter::put(const ClusterState& wide) {
  const PatchForest& patches = wide.patches();
  const auto lead = static_cast<std::size_t>(patches.lead_bands() * patches.terms());
  std::vector<float> values;
  for (std::size_t n = 0; n < patches.size(); ++n) {
    if (!patches.node(n).leaf()) continue;
    for (const double e : patches.irradiance(n).subspan(lead))
      values.push_back(static_cast<float>(e));
  }
  ByteWriter writer;
  writer.put_all(values);
  SectionInfo info;
  const SegmentKind& kind = segment_.kind();
  info.place = {wide.id(), kind.section, kind.iteration, kind.run};
  info.count.patches = patches.size();
  segment_.put(info, writer.bytes());
}

void write_share_index(const std::string& run_directory, const Manifest& manifest,
                       const ShareIndex& index) {
  replace_file(index_path(run_directory), seal(index_format, {{"run", hash_text(manifest.run)},
                                                              {"iteration", manifest.iteration},
                                                              {"names", index.names},
                                                              {"per_file", index.per_file},
                                                              {"ranks", index.ranks},
                                                              {"iterations", index.iterations},
                                                              {"converged", index.converged},
                                                              {"difference", index.difference},
                                                              {"solve_s", index.solve_s}}));
}

std::optional<ShareIndex> read_share_index(const std::string& run_directory) {
  const std::string path = index_path(run_directory);
  if (std::error_code code; !std::filesystem::exists(path, code)) return std::nullopt;
  const std::optional<Manifest> manifest = read_manifest(RunLayout(run_directory));
  const std::vector<std::byte> bytes = read_file(path);
  std::optional<ShareIndex> index;
  unseal(index_format, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path,
         [&](const nlohmann::ordered_json& json) {
           if (manifest && json.at("iteration") == manifest->iteration &&
               hash_from_text(json.at("run").get<std::string>()) == manifest->run)
             index = index_from(json);
         });
  return index;
}

bool has_whole_shares(const std::string& run_directory, std::size_t clusters) {
  try {
    const std::optional<ShareIndex> index = read_share_index(run_directory);
    if (!index) return false;
    const Manifest manifest = committed_manifest(RunLayout(run_directory));
    for (const SegmentIndex& segment : share_segments(run_directory, manifest, *index)) {
      for (std::size_t i = 0; i < clusters; ++i) segment.read(ClusterId(i));
    }
    return true;
  } catch (const RunError&) {
    return false;
  }
}

double LightShares::radiosity(ClusterId cluster, std::size_t node, std::size_t share,
                              std::size_t band) const {
  const PatchForest& patches = clusters[cluster.index()].patches();
  return patches.radiosity(
      node)[share_band(bands, share, band) * static_cast<std::size_t>(patches.terms())];
}

double LightShares::irradiance(ClusterId cluster, std::size_t node, std::size_t share,
                               std::size_t band) const {
  const PatchForest& patches = clusters[cluster.index()].patches();
  return patches.irradiance(
      node)[share_band(bands, share, band) * static_cast<std::size_t>(patches.terms())];
}

LightShares read_light_shares(const std::string& run_directory, const Prepared& prepared,
                              std::span<const ClusterState> solution) {
  const Manifest manifest = committed_manifest(RunLayout(run_directory));
  const std::optional<ShareIndex> index = read_share_index(run_directory);
  if (!index) {
    throw InputError(run_directory, "shares", "there are none of this solution",
                     "find them with 'enfilade solve RUN --resume --shares'");
  }
  LightShares shares;
  shares.groups = share_groups(prepared.scene);
  shares.bands = static_cast<std::size_t>(prepared.scene.bands);
  std::vector<std::string> names;
  for (const ShareGroup& group : shares.groups) names.push_back(group.name);
  if (names != index->names)
    throw RunError(index_path(run_directory) + ": is of other lights; " + shares_remedy);
  shares.scene = share_scene(prepared.scene, shares.groups);
  const std::vector<SegmentIndex> segments =
      with_remedy([&] { return share_segments(run_directory, manifest, *index); });
  for (const ClusterState& whole : solution) {
    ClusterState& wide = shares.clusters.emplace_back(
        same_patches(whole, prepared.clusters[whole.id().index()], shares.scene));
    PatchForest& patches = wide.patches();
    copy_leaves(whole.patches(), patches);
    with_remedy([&] { read_leaves(segments, *index, wide); });
    const auto terms = static_cast<std::size_t>(patches.terms());
    for (std::size_t n = 0; n < patches.size(); ++n) {
      if (patches.node(n).leaf()) complete_leaf(patches.irradiance(n), shares.bands * terms, terms);
    }
    patches.pull();
  }
  return shares;
}

DimmedSolution dimmed(const LightShares& shares, const Prepared& prepared,
                      std::span<const double> factors) {
  DimmedSolution result{dimmed_scene(prepared.scene, shares.groups, factors), {}};
  for (const ClusterState& wide : shares.clusters) {
    ClusterState& state = result.clusters.emplace_back(
        same_patches(wide, prepared.clusters[wide.id().index()], result.scene));
    PatchForest& patches = state.patches();
    for (std::size_t n = 0; n < patches.size(); ++n) {
      if (!patches.node(n).leaf()) continue;
      const std::span<double> to = patches.irradiance(n);
      const std::span<const double> from = wide.patches().irradiance(n);
      for (std::size_t i = 0; i < factors.size(); ++i) {
        for (std::size_t k = 0; k < to.size(); ++k)
          to[k] += factors[i] * from[(1 + i) * to.size() + k];
      }
    }
    patches.pull();
  }
  return result;
}

}  // namespace enfilade
