#include "cluster_figures.hpp"

#include "hierarchy/cluster_state.hpp"
#include "run/manifest.hpp"
#include "run/section_file.hpp"

namespace enfilade::bench {

namespace {

ClusterFigures of_files(const RunLayout& layout, const Manifest& manifest) {
  ClusterFigures figures;
  figures.solved = true;
  const std::string common = layout.common();
  for (std::size_t c = 0; c < manifest.clusters; ++c) {
    const ClusterId id(c);
    const SectionFile geometry =
        read_section(RunLayout::geometry(common, id), {id, Section::geometry, 0, manifest.run});
    const SectionFile patches = read_section(
        RunLayout::patches(common, id, manifest.slot()),
        {id, Section::patches, static_cast<std::uint32_t>(manifest.iteration), manifest.run});
    const LinksPlace& at = patches.info.links;
    const SectionFile links = read_section(RunLayout::links(common, id, at.slot),
                                           {id, Section::links, at.iteration, manifest.run});
    figures.bytes.push_back(geometry.bytes.size() + patches.bytes.size());
    figures.work.push_back(static_cast<double>(links.info.count.links));
  }
  return figures;
}

ClusterFigures before_the_first_iteration(const Prepared& prepared) {
  ClusterFigures figures;
  for (const Cluster& cluster : prepared.clusters) {
    const ClusterState state(cluster, prepared.scene, Basis::linear);
    figures.bytes.push_back(state.bytes_of(Section::geometry).size() +
                            state.bytes_of(Section::patches).size());
    std::size_t visible = cluster.polygons.size();
    for (std::uint32_t to : prepared.graph.neighbours(cluster.id.index())) {
      visible += prepared.clusters[to].polygons.size();
    }
    figures.work.push_back(static_cast<double>(cluster.polygons.size()) *
                           static_cast<double>(visible));
  }
  return figures;
}

}  // namespace

ClusterFigures cluster_figures(const std::string& run_directory, const Prepared& prepared) {
  const RunLayout layout(run_directory);
  const std::optional<Manifest> manifest = read_manifest(layout);
  const bool usable = manifest && manifest->clusters == prepared.clusters.size();
  return usable ? of_files(layout, *manifest) : before_the_first_iteration(prepared);
}

}  // namespace enfilade::bench
