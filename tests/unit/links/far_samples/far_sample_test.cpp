// Points and rays together are unbiased: in closed rooms the form factors sum to 1, and what a box
// sends to a point is known in closed form.
#include "links/far_samples/far_sample.hpp"

#include <gtest/gtest.h>

#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "unit/far_field/building.hpp"
#include "unit/statistics.hpp"

namespace enfilade {
namespace {

/// A room of 5 x 4 x 2.5 m whose faces emit as they are numbered, and a small lamp at its ceiling.
struct LitRoom {
  testing::Building building;
  BuildingTree tree;
  BuildingLight light;
  CellSights sights;
  FarField field;
  FarView view;
  Occluders occluders;
  static constexpr double lamp_exitance = 500.0;

  static testing::Building lit(plan::Plan plan) {
    plan.rectangle({2, 2, 2.49}, {0, 0.1, 0}, {0.1, 0, 0});  // faces down
    testing::Building made(plan);
    for (std::size_t i = 0; i < made.scene.surfaces.size(); ++i)
      made.scene.surfaces[i].exitance = {static_cast<double>(i % 7)};
    made.scene.surfaces.back().exitance = {lamp_exitance};
    return made;
  }
  explicit LitRoom(const plan::Plan& of_plan)
      : building(lit(of_plan)),
        tree(building.clusters),
        light(tree, building.scene, building.clusters),
        sights(building.complex, building.clusters),
        field(tree, light, sights),
        view(field, ClusterId(0u)),
        occluders(building.clusters) {}

  /// One point and one ray; what stands between hides the point.
  FarSample sample(std::uint32_t node, const Vec3& x, const Vec3& n, Random& random) const {
    constexpr std::uint32_t nothing = RayScene::no_polygon;
    FarSample sum = point_of_node(view, node, x, n, random.uniform(), true, occluders, random);
    EXPECT_LE(sum.factor, 1.0);
    if (sum.factor > 0.0 && occluders.passage(x, sum.y, nothing, sum.polygon).share == 0.0)
      sum = {};
    const double r2 = random.uniform(), turn = random.uniform();
    const FarSample end =
        end_of_ray(view, node, x, n, cosine_direction(n, r2, turn), nothing, occluders);
    sum.factor += end.factor;
    sum.emitted += end.emitted;
    return sum;
  }
};

struct Place {
  Vec3 x, n;
};
/// In the middle, close to a wall that faces it, and near the lamp.
const std::vector<Place> places{
    {{2.5, 2, 1}, {0, 0, 1}}, {{0.01, 2, 1}, {-1, 0, 0}}, {{2.3, 2.2, 2.4}, {0, 0, 1}}};

TEST(FarSample, InABoxTheIrradianceIsThatOfTheClosedForm) {
  const LitRoom room(plan::one_room());
  Random random(3);
  for (const Place& place : places) {
    double want = 0.0;
    for (const Cluster& cluster : room.building.clusters) {
      for (const ClusterPolygon& polygon : cluster.polygons) {
        // The lamp hides next to nothing of the ceiling 1 cm above it, which it has cut out.
        want += point_to_polygon(place.x, place.n, polygon.polygon) *
                room.building.scene.surfaces[polygon.surface.index()].exitance[0];
      }
    }
    testing::Samples emitted, factor;
    for (int i = 0; i < 40000; ++i) {
      const FarSample s = room.sample(BuildingTree::root, place.x, place.n, random);
      emitted.add(s.emitted);
      factor.add(s.factor);
    }
    EXPECT_NEAR(emitted.mean(), want, 4.0 * emitted.error_of_mean() + 0.02 * want);
    EXPECT_TRUE(testing::has_mean(factor, 1.0, 3, 1e-6)) << place.x.x;
  }
}

TEST(FarSample, AmongFurnitureTheFactorsStillSumToOne) {
  plan::Plan plan = plan::one_room();
  plan.box({1, 1, 0}, {2, 2, 0.8}, false);
  plan.box({3, 2, 0}, {3.2, 3, 2}, false);
  const LitRoom room(plan);
  Random random(4);
  for (const Place& place : places) {
    testing::Samples factor;
    for (int i = 0; i < 40000; ++i)
      factor.add(room.sample(BuildingTree::root, place.x, place.n, random).factor);
    EXPECT_TRUE(testing::has_mean(factor, 1.0, 3, 1e-6)) << place.x.x;
  }
}

/// No ray ends on a pane: what it sends is drawn by points alone.
TEST(FarSample, APaneSendsAllItsLight) {
  LitRoom room(plan::one_room());
  for (Surface& surface : room.building.scene.surfaces) surface.exitance = {0.0};
  room.building.scene.surfaces.back().exitance = {LitRoom::lamp_exitance};
  const SurfaceId lamp(room.building.scene.surfaces.size() - 1);
  const Polygon* pane = nullptr;
  for (Cluster& cluster : room.building.clusters) {
    for (ClusterPolygon& polygon : cluster.polygons) {
      if (polygon.surface != lamp) continue;
      polygon.pane = true;
      polygon.transmittance = {0.5};
      pane = &polygon.polygon;
    }
  }
  ASSERT_NE(pane, nullptr);
  const BuildingLight light(room.tree, room.building.scene, room.building.clusters);
  const FarField field(room.tree, light, room.sights);
  const FarView view(field, ClusterId(0u));
  const Occluders occluders(room.building.clusters);
  ASSERT_TRUE(occluders.panes().any());
  Random random(8);
  for (const Place& place : {places[0], Place{{2.05, 2.05, 2.39}, {0, 0, 1}}}) {  // below it
    testing::Samples emitted;
    for (int i = 0; i < 40000; ++i) {
      emitted.add(point_of_node(view, BuildingTree::root, place.x, place.n, random.uniform(), true,
                                occluders, random)
                      .emitted);
    }
    const double want = point_to_polygon(place.x, place.n, *pane) * LitRoom::lamp_exitance;
    EXPECT_TRUE(testing::has_mean(emitted, want, 2, 1e-3)) << place.x.x;
  }
}

/// The two halves of the tree share what the whole sends.
TEST(FarSample, PartsOfANodeSendWhatTheWholeSends) {
  const LitRoom room(plan::one_room());
  Random random(6);
  const BuildingTree::Node& root = room.tree.node(BuildingTree::root);
  ASSERT_FALSE(root.leaf());
  testing::Samples factor;
  for (int i = 0; i < 400000; ++i) {
    factor.add(room.sample(root.left, places[0].x, places[0].n, random).factor +
               room.sample(root.right, places[0].x, places[0].n, random).factor);
  }
  EXPECT_TRUE(testing::has_mean(factor, 1.0, 1, 1e-6));
}

}  // namespace
}  // namespace enfilade
