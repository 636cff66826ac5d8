#include "visibility/cluster_graph.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "cells/byte_stream.hpp"

namespace enfilade {
namespace {

constexpr std::string_view mark = "enfilade-graph-1";

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

bool ClusterGraph::has_edge(std::size_t i, std::size_t j) const {
  const auto row = neighbours(i);
  return std::binary_search(row.begin(), row.end(), static_cast<std::uint32_t>(j));
}

std::string to_bytes(const ClusterGraph& graph) {
  ByteWriter out;
  for (const char c : mark) out.put(c);
  out.put(static_cast<std::uint64_t>(graph.size()));
  out.put(static_cast<std::uint64_t>(graph.edges()));
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    for (const std::uint32_t j : graph.neighbours(i)) {
      if (i > j) continue;
      out.put(i);
      out.put(j);
    }
  }
  return out.take();
}

ClusterGraph graph_from_bytes(std::string_view bytes) {
  ByteReader in(bytes, "visibility graph");
  in.expect(mark);
  const auto clusters = in.get<std::uint64_t>();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs(
      in.count<std::uint64_t>(in.get<std::uint64_t>()));
  for (auto& [a, b] : pairs) {
    a = in.get<std::uint32_t>();
    b = in.get<std::uint32_t>();
    if (a >= clusters || b >= clusters) throw RunError("visibility graph: an edge to no cluster");
  }
  in.expect_end();
  return {static_cast<std::size_t>(clusters), std::move(pairs)};
}

}  // namespace enfilade
