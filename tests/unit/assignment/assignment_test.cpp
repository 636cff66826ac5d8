#include "assignment/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "unit/visibility/test_graphs.hpp"

namespace enfilade {
namespace {

using test::building;

class EveryMethod : public testing::TestWithParam<AssignmentMethod> {
 protected:
  static AssignmentConfig config(int parts) {
    AssignmentConfig c;
    c.method = GetParam();
    c.parts = parts;
    return c;
  }
};

TEST_P(EveryMethod, LeavesNoPartEmpty) {
  const ClusterGraph graph = building(2, 6, 5, 0.1, 1);
  for (int parts : {1, 2, 3, 7, 16, 59, 60}) {
    const auto owner = assign(graph, {}, config(parts));
    ASSERT_EQ(owner.size(), graph.size());
    std::set<Rank> used(owner.begin(), owner.end());
    EXPECT_EQ(used.size(), static_cast<std::size_t>(parts));
    EXPECT_GE(used.begin()->value, 0);
    EXPECT_LT(used.rbegin()->value, parts);
  }
}

TEST_P(EveryMethod, TakesMoreRanksThanClusters) {
  const ClusterGraph graph = building(1, 1, 3, 0.0, 1);
  const auto owner = assign(graph, {}, config(16));
  EXPECT_EQ(std::set<Rank>(owner.begin(), owner.end()).size(), 3u);
}

TEST_P(EveryMethod, TakesGraphsWithoutEdgesOrNodes) {
  EXPECT_TRUE(assign(ClusterGraph(0, {}), {}, config(4)).empty());
  const auto owner = assign(ClusterGraph(20, {}), {}, config(4));
  EXPECT_DOUBLE_EQ(quality(ClusterGraph(20, {}), owner, 4).imbalance, 1.0);
}

TEST_P(EveryMethod, IsDeterministic) {
  const ClusterGraph graph = building(2, 20, 10, 0.05, 3);
  EXPECT_EQ(assign(graph, {}, config(5)), assign(graph, {}, config(5)));
}

INSTANTIATE_TEST_SUITE_P(Assignment, EveryMethod,
                         testing::Values(AssignmentMethod::kmeans, AssignmentMethod::metis,
                                         AssignmentMethod::greedy, AssignmentMethod::round_robin));

TEST(Assignment, NeighboursStayTogether) {
  const ClusterGraph graph = building(2, 30, 12, 0.05, 6);
  AssignmentConfig config;
  config.parts = 4;
  const auto cut = [&](AssignmentMethod method) {
    config.method = method;
    return quality(graph, assign(graph, {}, config), config.parts).edge_cut;
  };
  EXPECT_LT(cut(AssignmentMethod::kmeans), cut(AssignmentMethod::round_robin) / 4);
  EXPECT_LT(cut(AssignmentMethod::metis), cut(AssignmentMethod::round_robin) / 4);
  EXPECT_LT(cut(AssignmentMethod::greedy), cut(AssignmentMethod::round_robin) / 4);
}

TEST(Assignment, QualityCountsCutEdgesAndTheLargestPart) {
  const ClusterGraph path(4, {{0, 1}, {1, 2}, {2, 3}});
  const std::vector<Rank> owner{Rank{0}, Rank{0}, Rank{1}, Rank{0}};
  const PartitionQuality q = quality(path, owner, 2);
  EXPECT_EQ(q.edge_cut, 2u);
  EXPECT_DOUBLE_EQ(q.imbalance, 1.5);
}

TEST(Assignment, NamesItsMethods) {
  EXPECT_EQ(assignment_method("kmeans"), AssignmentMethod::kmeans);
  EXPECT_EQ(assignment_method("metis"), AssignmentMethod::metis);
  EXPECT_EQ(assignment_method("greedy"), AssignmentMethod::greedy);
  EXPECT_EQ(assignment_method("round-robin"), AssignmentMethod::round_robin);
  for (const char* name : assignment_names()) EXPECT_STREQ(name_of(assignment_method(name)), name);
  EXPECT_THROW(assignment_method("k-means"), InputError);
}

}  // namespace
}  // namespace enfilade
