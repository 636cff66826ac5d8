#include "run/solution.hpp"

#include "base/error.hpp"
#include "run/section_file.hpp"

namespace enfilade {

ClusterState read_cluster(const RunLayout& layout, const Manifest& manifest, ClusterId id,
                          bool links) {
  const std::string common = layout.common();
  const auto place = [&](Section section, std::uint32_t iteration) {
    return SectionPlace{id, section, iteration, manifest.run};
  };
  const auto geometry = read_section(RunLayout::geometry(common, id), place(Section::geometry, 0));
  const auto patches =
      read_section(RunLayout::patches(common, id, manifest.slot()),
                   place(Section::patches, static_cast<std::uint32_t>(manifest.iteration)));
  std::vector<std::byte> link_bytes;
  if (links) {
    const LinksPlace& at = patches.info.links;
    link_bytes =
        read_section(RunLayout::links(common, id, at.slot), place(Section::links, at.iteration))
            .bytes;
  }
  ClusterState state(geometry.bytes, patches.bytes, link_bytes);
  const auto bands = static_cast<std::size_t>(state.bands());
  if (!manifest.correction.empty()) {
    if (manifest.correction.size() != manifest.unknowns.count * bands ||
        state.aggregates().size() > manifest.unknowns.aggregates[id.index()]) {
      throw RunError(layout.run +
                     ": the correction there is of other clusters; solve again without --resume");
    }
    state.correct(manifest.unknowns.of(id, manifest.correction, bands));
  }
  return state;
}

std::vector<ClusterState> read_solution(const std::string& run_directory, bool links) {
  const RunLayout layout(run_directory);
  const Manifest manifest = committed_manifest(layout);
  std::vector<ClusterState> states;
  states.reserve(manifest.clusters);
  for (std::size_t i = 0; i < manifest.clusters; ++i)
    states.push_back(read_cluster(layout, manifest, ClusterId(i), links));
  return states;
}

}  // namespace enfilade
