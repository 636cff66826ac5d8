// No ray out of a cluster may bring more than the portals' bound: held against the rays themselves.
#include "far_field/portal_exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "geometry/sampling.hpp"
#include "raycast/ray_scene.hpp"
#include "unit/far_field/building.hpp"

namespace enfilade {
namespace {

using testing::Building;

/// Five rooms in a row with doors out of line, and a table in the second.
plan::Plan row_of_rooms() {
  plan::Plan plan;
  plan.box({0, 0, 0}, {20, 4, 2.5}, true);
  for (int i = 1; i < 5; ++i) {
    const double door = i % 2 == 0 ? 0.5 : 2.5;
    plan.wall_with_door(4 * i, 0, 4, 2.5, door, door + 0.9, 2);
  }
  plan.box({5, 1, 0}, {6, 2, 0.8}, false);
  return plan;
}

/// The direct exchange areas from one cluster to all nodes, by rays.
class RayExchange {
 public:
  RayExchange(const Building& building, const BuildingTree& tree)
      : building_(building), tree_(tree), rays_(polygons_of(building)) {
    for (const Cluster& cluster : building.clusters)
      cluster_of_.insert(cluster_of_.end(), cluster.polygons.size(), cluster.id);
  }

  /// Returns by node the area times form factor, m2, and its standard deviation.
  std::vector<std::pair<double, double>> from(const Cluster& cluster) {
    constexpr int samples = 4000;
    std::vector<int> hits(tree_.nodes().size(), 0);
    for (int i = 0; i < samples; ++i) {
      double pick = random_.uniform() * cluster.area_m2;
      std::size_t k = 0;
      while (k + 1 < cluster.polygons.size() && pick >= area_m2(cluster.polygons[k].polygon))
        pick -= area_m2(cluster.polygons[k++].polygon);
      const Polygon& polygon = cluster.polygons[k].polygon;
      const Vec3 n = normal(polygon);
      const Vec3 x = uniform_point(polygon, random_.uniform(), random_.uniform());
      const double r2 = random_.uniform(), turn = random_.uniform();
      const RayHit hit = rays_.closest(x, cosine_direction(n, r2, turn));
      if (hit.any() && hit.front) ++hits[tree_.leaf_of(cluster_of_[hit.polygon])];
    }
    for (std::size_t i = hits.size(); i-- > 0;) {
      const BuildingTree::Node& node = tree_.nodes()[i];
      if (!node.leaf()) hits[i] = hits[node.left] + hits[node.right];
    }
    std::vector<std::pair<double, double>> exchange;
    for (const int n : hits) {
      exchange.emplace_back(cluster.area_m2 * n / samples,
                            cluster.area_m2 * std::sqrt(static_cast<double>(n)) / samples);
    }
    return exchange;
  }

 private:
  static std::vector<Polygon> polygons_of(const Building& building) {
    std::vector<Polygon> polygons;
    for (const Cluster& cluster : building.clusters) {
      for (const ClusterPolygon& polygon : cluster.polygons) polygons.push_back(polygon.polygon);
    }
    return polygons;
  }

  const Building& building_;
  const BuildingTree& tree_;
  RayScene rays_;
  std::vector<ClusterId> cluster_of_;
  Random random_{7};
};

TEST(PortalExchange, NoRaysBringMoreThanTheBound) {
  plan::Plan turned = row_of_rooms();
  turned.transform(plan::turn_and_move(10.0));
  for (const plan::Plan& plan :
       {row_of_rooms(), turned, plan::two_storeys(), plan::two_rooms(), plan::l_corridor()}) {
    const Building building(plan);
    const BuildingTree tree(building.clusters);
    const CellSights sights(building.complex, building.clusters);
    const PortalExchange exchange(tree, sights);
    RayExchange rays(building, tree);
    std::size_t bounded = 0, tight = 0;
    for (const Cluster& receiver : building.clusters) {
      const auto own = sights.cells_of(receiver.id);
      const auto found = rays.from(receiver);
      for (std::uint32_t node = 0; node < tree.nodes().size(); ++node) {
        const double bound = exchange.bound_m2(own, receiver.bounds, receiver.area_m2, node);
        const auto& [m2, sigma] = found[node];
        EXPECT_LE(m2, bound + 4.0 * sigma) << receiver.id.value << " from node " << node;
        if (std::isinf(bound)) continue;
        ++bounded;
        tight += bound < 0.25 * receiver.area_m2 ? 1 : 0;
      }
    }
    if (building.complex.portals().empty()) continue;
    EXPECT_GT(bounded, 0u);
    EXPECT_GT(tight, bounded / 4);  // a bound that is no bound would pass as well
  }
}

TEST(PortalExchange, OneDoorLetsItsAreaPass) {
  const Building building(plan::two_rooms());
  const BuildingTree tree(building.clusters);
  const CellSights sights(building.complex, building.clusters);
  const PortalExchange exchange(tree, sights);
  const CellId near = building.complex.locate({1, 1, 1}), far = building.complex.locate({8, 1, 1});
  ASSERT_NE(near, far);
  const Box room{{0, 0, 0}, {4, 4, 2.5}};
  const std::vector<CellId> own{near};
  std::size_t nodes = 0;
  for (std::uint32_t node = 0; node < tree.nodes().size(); ++node) {
    const BuildingTree::Node& n = tree.node(node);
    const double bound = exchange.bound_m2(own, room, 72.0, node);
    const std::uint32_t other = tree.place_of(far);
    if (n.first_cell == other && n.end_cell == other + 1) {
      EXPECT_NEAR(bound, 0.9 * 2.0, 1e-6) << node;
      ++nodes;
    } else {
      EXPECT_TRUE(std::isinf(bound)) << node;
    }
  }
  EXPECT_GT(nodes, 0u);
}

/// A polygon that reaches into the receiver's cell is not behind its doors.
TEST(PortalExchange, AClusterThatSticksIntoACellIsNotBounded) {
  Building building(row_of_rooms());
  const CellId here = building.complex.locate({1, 1, 1}),
               there = building.complex.locate({18, 1, 1});
  const std::vector<CellId> own{here};
  const Box room{{0, 0, 0}, {4, 4, 2.5}};
  for (const bool sticks_out : {false, true}) {
    Cluster lamp;
    lamp.id = ClusterId(building.clusters.size());
    lamp.cell = there;
    const double x = sticks_out ? 1.0 : 18.0;
    lamp.polygons.push_back({SurfaceId(0u), {{x, 1, 2}, {x, 2, 2}, {x + 1, 2, 2}, {x + 1, 1, 2}}});
    if (sticks_out)
      lamp.polygons.push_back({SurfaceId(0u), {{18, 1, 2}, {18, 2, 2}, {19, 2, 2}, {19, 1, 2}}});
    for (const ClusterPolygon& polygon : lamp.polygons) {
      lamp.bounds.add(bounds(polygon.polygon));
      lamp.area_m2 += area_m2(polygon.polygon);
    }
    std::vector<Cluster> clusters = building.clusters;
    clusters.push_back(lamp);
    const BuildingTree tree(clusters);
    const CellSights sights(building.complex, clusters);
    const PortalExchange exchange(tree, sights);
    EXPECT_EQ(std::isinf(exchange.bound_m2(own, room, 72.0, tree.leaf_of(lamp.id))), sticks_out);
  }
}

}  // namespace
}  // namespace enfilade
