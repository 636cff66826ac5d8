#include "base/smaller_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/random.hpp"

namespace enfilade {
namespace {

struct Graph {
  std::vector<std::vector<std::uint32_t>> edges;
  std::vector<double> sizes;
  mutable std::size_t looked_at = 0;

  explicit Graph(std::size_t nodes) : edges(nodes), sizes(nodes, 1.0) {}
  void join(std::uint32_t a, std::uint32_t b) {
    edges[a].push_back(b);
    edges[b].push_back(a);
  }
  PartGraph view() const {
    return {[this](std::uint32_t node, const std::function<void(std::uint32_t)>& take) {
              ++looked_at;
              for (const std::uint32_t other : edges[node]) take(other);
            },
            [this](std::uint32_t node) { return sizes[node]; },
            std::accumulate(sizes.begin(), sizes.end(), 0.0)};
  }
};

/// Part numbers by relabelling until nothing changes.
std::vector<std::uint32_t> parts_of(const Graph& graph) {
  std::vector<std::uint32_t> part(graph.edges.size());
  std::iota(part.begin(), part.end(), 0u);
  for (bool again = true; again;) {
    again = false;
    for (std::uint32_t a = 0; a < part.size(); ++a) {
      for (const std::uint32_t b : graph.edges[a]) {
        again |= part[b] < part[a];
        part[a] = std::min(part[a], part[b]);
      }
    }
  }
  return part;
}

TEST(SmallerParts, AreThoseOfAnyGraphButTheLargest) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const auto nodes = static_cast<std::uint32_t>(2 + random.below(30));
    Graph graph(nodes);
    for (std::uint64_t i = random.below(nodes); i > 0; --i) {
      graph.join(static_cast<std::uint32_t>(random.below(nodes)),
                 static_cast<std::uint32_t>(random.below(nodes)));
    }
    for (double& size : graph.sizes) size = 0.1 + random.uniform();
    const std::vector<std::uint32_t> part = parts_of(graph);
    std::vector<double> size(nodes, 0.0);
    for (std::uint32_t i = 0; i < nodes; ++i) size[part[i]] += graph.sizes[i];
    std::vector<std::uint32_t> starts;  // some in each part, so that the rest is the last part's
    for (std::uint32_t i = 0; i < nodes; ++i) {
      if (part[i] == i || random.below(3) == 0) starts.push_back(i);
    }
    const auto largest =
        static_cast<std::uint32_t>(std::max_element(size.begin(), size.end()) - size.begin());
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < nodes; ++i) {
      if (part[i] != largest) expected.push_back(i);
    }
    EXPECT_EQ(smaller_parts(starts, graph.view()), expected) << trial;
  }
}

TEST(SmallerParts, AreFoundWithoutWalkingTheLargest) {
  Graph graph(10000);  // a chain, cut near one end
  for (std::uint32_t i = 0; i + 1 < 10000; ++i) {
    if (i != 9) graph.join(i, i + 1);
  }
  const std::vector<std::uint32_t> found =
      smaller_parts(std::vector<std::uint32_t>{9, 10}, graph.view());
  EXPECT_EQ(found.size(), 10u);
  EXPECT_EQ(found.back(), 9u);
  EXPECT_LT(graph.looked_at, 40u);
}

TEST(SmallerParts, OfManyNodesMayBeSmall) {
  Graph graph(11);  // ten small nodes in a chain, and one large one
  for (std::uint32_t i = 0; i < 9; ++i) graph.join(i, i + 1);
  graph.sizes[10] = 100.0;
  EXPECT_EQ(smaller_parts(std::vector<std::uint32_t>{0, 10}, graph.view()).size(), 10u);
}

}  // namespace
}  // namespace enfilade
