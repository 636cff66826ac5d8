// Compressed rows from pairs.
#include "visibility/cluster_graph.hpp"

#include <algorithm>
#include <string>

#include "base/byte_stream.hpp"
#include "base/error.hpp"

namespace enfilade {
namespace {

constexpr std::string_view mark = "enfilade-graph-2";

}  // namespace

ClusterGraph::ClusterGraph(std::size_t clusters,
                           std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs) {
  for (auto& [a, b] : pairs) {
    ENFILADE_CHECK(a < clusters && b < clusters, std::to_string(a) + ", " + std::to_string(b));
    if (a > b) std::swap(a, b);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::erase_if(pairs, [](const auto& pair) { return pair.first == pair.second; });
  offsets_.assign(clusters + 1, 0);
  for (const auto& [a, b] : pairs) {
    ++offsets_[a + 1];
    ++offsets_[b + 1];
  }
  for (std::size_t i = 0; i < clusters; ++i) offsets_[i + 1] += offsets_[i];
  targets_.resize(2 * pairs.size());
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  // Smaller neighbours first, then larger ones: in this order each row comes out sorted.
  for (const auto& [a, b] : pairs) targets_[next[b]++] = a;
  for (const auto& [a, b] : pairs) targets_[next[a]++] = b;
}

std::vector<ClusterId> ClusterGraph::visible_to(ClusterId receiver) const {
  const auto others = neighbours(receiver.index());
  std::vector<ClusterId> visible(others.begin(), others.end());
  visible.insert(std::lower_bound(visible.begin(), visible.end(), receiver), receiver);
  return visible;
}

ClusterGraph neighbour_graph(const BuildingTree& tree, std::size_t reach) {
  const std::span<const ClusterId> clusters = tree.clusters();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(clusters.size(), i + 1 + reach); ++j) {
      pairs.emplace_back(clusters[i].value, clusters[j].value);
    }
  }
  return {clusters.size(), std::move(pairs)};
}

std::string to_bytes(const ClusterGraph& graph) {
  ByteWriter out;
  out.put_mark(mark);
  out.put(static_cast<std::uint64_t>(graph.size()));
  for (std::size_t i = 0; i < graph.size(); ++i) {
    const std::span<const std::uint32_t> row = graph.neighbours(i);
    const auto later = std::upper_bound(row.begin(), row.end(), static_cast<std::uint32_t>(i));
    out.put_all(std::vector<std::uint32_t>(later, row.end()));
  }
  return out.text();
}

ClusterGraph graph_from_bytes(std::string_view bytes) {
  ByteReader in(bytes, "graph");
  in.expect(mark);
  const std::size_t clusters = in.get_count(sizeof(std::uint64_t));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < clusters; ++i) {
    for (const std::uint32_t j : in.get_all<std::uint32_t>()) {
      if (j >= clusters) throw RunError("a cluster that there is not");
      pairs.emplace_back(i, j);
    }
  }
  in.expect_end();
  return {clusters, std::move(pairs)};
}

bool ClusterGraph::has_edge(std::size_t i, std::size_t j) const {
  const auto row = neighbours(i);
  return std::binary_search(row.begin(), row.end(), static_cast<std::uint32_t>(j));
}

}  // namespace enfilade
