#include "far_field/far_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/random.hpp"
#include "geometry/sampling.hpp"
#include "unit/far_field/building.hpp"
#include "unit/far_field/panels.hpp"

namespace enfilade {
namespace {

TEST(FoldDirection, ComesBackUnfolded) {
  Random random(3);
  std::vector<Vec3> all{{0, 0, 0},  {1, 0, 0}, {-1, 0, 0}, {0, 1, 0},
                        {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 1000; ++i)
    all.push_back(sphere_direction(2.0 * random.uniform() - 1.0, random.uniform()));
  for (const Vec3& w : all) {
    const Vec2 folded = fold_direction(w);
    // As a link keeps it.
    const Vec2 kept(static_cast<float>(folded.x), static_cast<float>(folded.y));
    EXPECT_LT(glm::length(unfold_direction(folded) - w), 1e-12) << w.x << " " << w.y << " " << w.z;
    EXPECT_LT(glm::length(unfold_direction(kept) - w), 1e-6) << w.x << " " << w.y << " " << w.z;
    if (w != Vec3(0.0)) {
      EXPECT_LE(std::max(std::abs(folded.x), std::abs(folded.y)), 1.0);
    }
  }
}

using testing::Building;

/// Stratified picks draw each cluster as often as its probability says, and the probabilities of
/// all clusters that can be drawn sum to 1; what is left of a pick is uniform again.
TEST(FarView, ProbabilitiesOfPicksSumToOne) {
  const testing::Panels panels(testing::mixed_panels());
  const BuildingTree tree(panels.clusters);
  const BuildingLight light(tree, panels.scene, panels.clusters);
  const Building rooms(plan::one_room());
  const CellSights sights(rooms.complex, panels.clusters);
  const FarField field(tree, light, sights);
  const FarView view(field, ClusterId(0u));
  constexpr int picks = 20000;
  for (const Vec3& x : {Vec3(40, 3, 20), Vec3(4, 3, 1), Vec3(-10, -10, -5)}) {
    std::map<ClusterId, double> probabilities;
    std::map<ClusterId, int> drawn;
    double left = 0.0;
    for (int i = 0; i < picks; ++i) {
      double pick = (i + 0.5) / picks, probability = 0.0;
      const ClusterId cluster = view.pick_cluster(BuildingTree::root, x, pick, probability);
      EXPECT_GT(probability, 0.0);
      EXPECT_GE(pick, 0.0);
      EXPECT_LT(pick, 1.0);
      left += pick;
      const auto [known, added] = probabilities.emplace(cluster, probability);
      EXPECT_NEAR(known->second, probability, 1e-12);
      EXPECT_NEAR(view.probability_of(BuildingTree::root, x, cluster), probability, 1e-12);
      ++drawn[cluster];
    }
    EXPECT_EQ(probabilities.size(), panels.clusters.size());
    double sum = 0.0;
    for (const auto& [cluster, probability] : probabilities) {
      sum += probability;
      EXPECT_NEAR(drawn[cluster], probability * picks, 2.0) << cluster.value;
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
    EXPECT_NEAR(left / picks, 0.5, 1e-2);
  }
}

TEST(FarView, DrawsMostWhatSendsMost) {
  // Seen from above: two panels, of which one is turned away, and one emits four times as much.
  const std::vector<testing::Panel> three{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1.0},
                                          {{3, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4.0},
                                          {{6, 0, 0}, {0, 1, 0}, {1, 0, 0}, 4.0}};
  const testing::Panels panels(three);
  const BuildingTree tree(panels.clusters);
  const BuildingLight light(tree, panels.scene, panels.clusters);
  const Building rooms(plan::one_room());
  const CellSights sights(rooms.complex, panels.clusters);
  const FarField field(tree, light, sights);
  const FarView view(field, ClusterId(0u));
  std::map<ClusterId, int> drawn;
  for (int i = 0; i < 1000; ++i) {
    double pick = (i + 0.5) / 1000, probability = 0.0;
    ++drawn[view.pick_cluster(BuildingTree::root, {3.5, 0.5, 30.0}, pick, probability)];
  }
  EXPECT_GT(drawn[ClusterId(1u)], drawn[ClusterId(0u)]);
  EXPECT_GT(drawn[ClusterId(0u)], drawn[ClusterId(2u)]);
}

/// A node may be seen where one of its clusters' cells may.
TEST(FarView, SeesANodeWhereItSeesOneOfItsCells) {
  plan::Plan plan;  // doors that are out of line: the first room does not see the last
  plan.box({0, 0, 0}, {20, 4, 2.5}, true);
  for (int i = 1; i < 5; ++i) {
    const double door = i % 2 == 0 ? 0.5 : 2.5;
    plan.wall_with_door(4 * i, 0, 4, 2.5, door, door + 0.9, 2);
  }
  const Building building(plan);
  const BuildingTree tree(building.clusters);
  const BuildingLight light(tree, building.scene, building.clusters);
  const CellSights sights(building.complex, building.clusters);
  const FarField field(tree, light, sights);
  std::size_t hidden = 0;
  for (const Cluster& receiver : building.clusters) {
    const FarView view(field, receiver.id);
    const std::vector<CellId> seen = sights.seen_by(receiver.id);
    const auto sees = [&](ClusterId cluster) {
      const auto lies_in = sights.cells_of(cluster);
      return std::any_of(lies_in.begin(), lies_in.end(), [&](CellId cell) {
        return std::binary_search(seen.begin(), seen.end(), cell);
      });
    };
    EXPECT_TRUE(view.may_see(BuildingTree::root));
    for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
      const BuildingTree::Node& node = tree.node(i);
      const auto own = tree.clusters().subspan(node.begin, node.end - node.begin);
      const bool any = std::any_of(own.begin(), own.end(), sees);
      if (any) {
        EXPECT_TRUE(view.may_see(i)) << receiver.id.value << " sees " << i;
      }
      if (node.leaf()) {
        EXPECT_EQ(view.may_see(i), any) << receiver.id.value << " sees " << i;
      }
      hidden += view.may_see(i) ? 0 : 1;
    }
  }
  EXPECT_GT(hidden, 0u);
}

}  // namespace
}  // namespace enfilade
