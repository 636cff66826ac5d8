#include "partition_figures.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace enfilade::bench {
namespace {

// Two triangles {0, 1, 2} and {3, 4, 5} with the edges 2-3 and 2-4 between them.
const ClusterGraph two_triangles(6,
                                 {{0, 1}, {1, 2}, {0, 2}, {3, 4}, {4, 5}, {3, 5}, {2, 3}, {2, 4}});
const ClusterFigures clusters{{1, 10, 100, 1000, 10000, 100000}, {1, 1, 1, 2, 2, 2}, false};

TEST(PartitionFigures, CountForeignClustersOnceAsRanksSeeThem) {
  const std::vector<Rank> owner{Rank{0}, Rank{0}, Rank{0}, Rank{1}, Rank{1}, Rank{1}};
  const PartitionFigures f = partition_figures(two_triangles, {}, clusters, owner, 2);
  EXPECT_DOUBLE_EQ(f.cut_share, 2.0 / 8.0);
  // Rank 0 loads 3 and 4, rank 1 loads 2, though both of its clusters there see it.
  EXPECT_DOUBLE_EQ(f.max_foreign_bytes, 11000.0);
  EXPECT_DOUBLE_EQ(f.mean_foreign_bytes, 0.5 * (11000.0 + 100.0));
  EXPECT_DOUBLE_EQ(f.clusters_balance, 1.0);
  EXPECT_DOUBLE_EQ(f.work_balance, 6.0 / 4.5);
}

TEST(PartitionFigures, WeighTheCutByFormFactors) {
  // A path of three clusters of pi square metres: near 1 m (factor 1/2), far 3 m (factor 1/10).
  std::vector<Cluster> path(3);
  for (std::size_t i = 0; i < 3; ++i) {
    path[i].bounds.add(Vec3(std::vector{0.0, 1.0, 4.0}[i], 0, 0));
    path[i].area_m2 = std::numbers::pi;
  }
  const ClusterGraph graph(3, {{0, 1}, {1, 2}});
  const std::vector<Rank> owner{Rank{0}, Rank{0}, Rank{1}};
  const PartitionFigures f =
      partition_figures(graph, FormFactorEstimate(path), {{1, 1, 1}, {1, 1, 1}, false}, owner, 2);
  EXPECT_DOUBLE_EQ(f.cut_share, 0.5);
  EXPECT_NEAR(f.form_factor_cut_share, 0.1 / 0.6, 1e-12);
}

TEST(PartitionFigures, OneRankLoadsNothing) {
  const std::vector<Rank> owner(6, Rank{0});
  const PartitionFigures f = partition_figures(two_triangles, {}, clusters, owner, 1);
  EXPECT_EQ(f.cut_share, 0.0);
  EXPECT_EQ(f.max_foreign_bytes, 0.0);
  EXPECT_DOUBLE_EQ(f.work_balance, 1.0);
}

}  // namespace
}  // namespace enfilade::bench
