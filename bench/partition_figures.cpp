#include "partition_figures.hpp"

#include <algorithm>
#include <numeric>

namespace enfilade::bench {

namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

/// Bytes of the clusters of others that each rank's own may see, each once.
std::vector<double> foreign_bytes(const ClusterGraph& graph, const ClusterFigures& clusters,
                                  std::span<const Rank> owner, std::size_t parts) {
  std::vector<double> bytes(parts, 0.0);
  std::vector<std::uint32_t> seen_by(parts);
  for (std::size_t v = 0; v < graph.size(); ++v) {
    // Seen from the shooter's side: every rank but its own that has a cluster beside it loads it.
    seen_by.clear();
    for (std::uint32_t to : graph.neighbours(v)) {
      if (owner[to] != owner[v]) seen_by.push_back(static_cast<std::uint32_t>(owner[to].value));
    }
    std::sort(seen_by.begin(), seen_by.end());
    const auto end = std::unique(seen_by.begin(), seen_by.end());
    for (auto rank = seen_by.begin(); rank != end; ++rank) {
      bytes[*rank] += static_cast<double>(clusters.bytes[v]);
    }
  }
  return bytes;
}

double form_factor_cut_share(const ClusterGraph& graph, const FormFactorEstimate& weights,
                             std::span<const Rank> owner) {
  double all = 0.0, cut = 0.0;
  for (std::size_t v = 0; v < graph.size(); ++v) {
    for (std::uint32_t to : graph.neighbours(v)) {
      const double weight = weights.between(v, to);
      all += weight;
      if (owner[v] != owner[to]) cut += weight;
    }
  }
  return all > 0.0 ? cut / all : 0.0;
}

}  // namespace

PartitionFigures partition_figures(const ClusterGraph& graph, const FormFactorEstimate& weights,
                                   const ClusterFigures& clusters, std::span<const Rank> owner,
                                   int parts) {
  PartitionFigures figures;
  const PartitionQuality q = quality(graph, owner, parts);
  figures.clusters_balance = q.imbalance;
  if (graph.edges() > 0) {
    figures.cut_share = static_cast<double>(q.edge_cut) / static_cast<double>(graph.edges());
  }
  figures.form_factor_cut_share = form_factor_cut_share(graph, weights, owner);
  std::vector<double> work(static_cast<std::size_t>(parts), 0.0);
  for (std::size_t v = 0; v < owner.size(); ++v) {
    work[static_cast<std::size_t>(owner[v].value)] += clusters.work[v];
  }
  if (mean(work) > 0.0) figures.work_balance = largest(work) / mean(work);
  const std::vector<double> bytes = foreign_bytes(graph, clusters, owner, work.size());
  figures.mean_foreign_bytes = mean(bytes);
  figures.max_foreign_bytes = largest(bytes);
  return figures;
}

}  // namespace enfilade::bench
