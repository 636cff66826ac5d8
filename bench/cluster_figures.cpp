#include "cluster_figures.hpp"

#include "hierarchy/cluster_state.hpp"
#include "run/solution.hpp"

namespace enfilade::bench {

namespace {

ClusterFigures of_files(const RunLayout& layout, const Manifest& manifest) {
  ClusterFigures figures;
  figures.solved = true;
  const SolutionReader solution(layout, manifest);
  for (std::size_t c = 0; c < manifest.clusters; ++c) {
    const ClusterState state = solution.read(ClusterId(c), true);
    figures.bytes.push_back(state.bytes_of(Section::geometry).size() +
                            state.bytes_of(Section::patches).size());
    figures.work.push_back(static_cast<double>(state.links().size()));
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
