#include "run/solution.hpp"

#include "base/error.hpp"

namespace enfilade {

SolutionReader::SolutionReader(const RunLayout& layout, const Manifest& manifest)
    : run_directory_(layout.run),
      common_(layout.common()),
      manifest_(manifest),
      geometry_(common_, {RunLayout::geometry(), Section::geometry, 0, manifest.run},
                manifest.clusters, manifest.ranks),
      patches_(common_,
               {RunLayout::patches(RunLayout::slot_of(manifest.iteration)), Section::patches,
                static_cast<std::uint32_t>(manifest.iteration), manifest.run},
               manifest.clusters, manifest.ranks) {}

ClusterState SolutionReader::read(ClusterId id, bool links) const {
  const SectionFile geometry = geometry_.read(id), patches = patches_.read(id);
  std::vector<std::byte> link_bytes;
  if (links) {
    const auto& [iteration, at] = patches.info.links;
    link_bytes = read_section(segment_path(common_, RunLayout::links(iteration), at.rank, at.part),
                              at.offset, {id, Section::links, iteration, manifest_.run})
                     .bytes;
  }
  ClusterState state(geometry.bytes, patches.bytes, link_bytes);
  const auto bands = static_cast<std::size_t>(state.bands());
  if (!manifest_.correction.empty()) {
    if (manifest_.correction.size() != manifest_.unknowns.count * bands ||
        state.aggregates().size() > manifest_.unknowns.aggregates[id.index()]) {
      throw RunError(run_directory_ +
                     ": the correction there is of other clusters; solve again without --resume");
    }
    state.correct(manifest_.unknowns.of(id, manifest_.correction, bands));
  }
  return state;
}

std::vector<ClusterState> read_solution(const std::string& run_directory, bool links) {
  const RunLayout layout(run_directory);
  const Manifest manifest = committed_manifest(layout);
  const SolutionReader reader(layout, manifest);
  std::vector<ClusterState> states;
  states.reserve(manifest.clusters);
  for (std::size_t i = 0; i < manifest.clusters; ++i)
    states.push_back(reader.read(ClusterId(i), links));
  return states;
}

}  // namespace enfilade
