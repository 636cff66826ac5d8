#include "coarse/far_flow.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "unit/far_field/panels.hpp"

namespace enfilade {
namespace {

using testing::mixed_panels;
using testing::Panels;

/// Twelve panels, each a cluster with an unknown of its own; panel i reflects i, whatever its area.
struct Building {
  Panels panels{mixed_panels()};
  BuildingTree tree{panels.clusters};
  BuildingLight light{tree, panels.scene, panels.clusters};
  CoarseUnknowns coarse;
  std::unique_ptr<FarUnknowns> unknowns;

  Building() {
    coarse.first.resize(panels.clusters.size());
    std::iota(coarse.first.begin(), coarse.first.end(), 0u);
    coarse.aggregates.assign(panels.clusters.size(), 1);
    coarse.count = panels.clusters.size();
    for (std::size_t i = 0; i < panels.clusters.size(); ++i) {
      const Cluster& cluster = panels.clusters[i];
      ClusterState state(cluster, panels.scene, Basis::constant);
      state.patches().radiosity(0)[0] +=
          static_cast<double>(i) / cluster.area_m2;  // exitance at first
      light.set(cluster.id, light_of(state));
    }
    light.sum();
    unknowns = std::make_unique<FarUnknowns>(light, coarse);
  }

  /// What links from these nodes bring to the first cluster, each the power given.
  CoarseRow::Far from(const std::vector<std::pair<std::uint32_t, double>>& nodes) const {
    const ClusterState receiver(panels.clusters[0], panels.scene, Basis::constant);
    FarFlow flow(receiver.patches(), receiver.aggregates());
    for (const auto& [node, power] : nodes) {
      Link link;
      link.shooter.root = PatchId::group_bit | node;
      const float transport[] = {1.0f, 1.0f, 0.0f};
      flow.add(link, transport, std::span(&power, 1));
    }
    return flow.entries(*unknowns);
  }
};

/// By what each reflects, and none to a panel that reflects nothing; links of one node add up.
TEST(FarFlow, DividesPowerAmongTheUnknownsBelowANode) {
  const Building building;
  const std::uint32_t last = building.tree.leaf_of(ClusterId(11u));
  const CoarseRow::Far far =
      building.from({{BuildingTree::root, 60.0}, {last, 5.0}, {BuildingTree::root, 6.0}});
  ASSERT_EQ(far.columns.size(), 11u);
  ASSERT_EQ(far.flows.size(), 11u);
  for (std::uint32_t i = 1; i < 12; ++i) {
    EXPECT_EQ(far.columns[i - 1], i);
    EXPECT_NEAR(far.flows[i - 1], i + (i == 11 ? 5.0 : 0.0), 1e-9);  // 66 = 1 + 2 + ... + 11
  }
}

}  // namespace
}  // namespace enfilade
