// The transport of far links is unbiased: over many receiving patches the received power is that of
// the closed form.
#include <gtest/gtest.h>

#include <algorithm>

#include "cells/rooms/build_cells.hpp"
#include "geometry/form_factor.hpp"
#include "links/link_estimate.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"
#include "unit/far_field/panels.hpp"

namespace enfilade {
namespace {

using testing::Panel;

/// The receiver, 2 x 2 m at the origin, faces up.
constexpr Panel receiving_panel{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.0};

/// Panels 6 m and more above it, mirrored at x = 1: of unlike exitance, some nearly dark, some
/// turned away, some upright. A cluster that is wholly dark would not be sampled: the form factor
/// is that of the lit clusters.
std::vector<Panel> far_panels() {
  std::vector<Panel> panels;
  for (const bool left : {true, false}) {
    const auto at = [&](double x) { return left ? x : 2.0 - x; };
    const auto add = [&](double x0, double x1, double y, bool down, double exitance) {
      const double lo = std::min(at(x0), at(x1)), size = std::abs(x1 - x0);
      const Vec3 u(size, 0, 0), v(0, 1, 0);
      panels.push_back({{lo, y, 6}, down ? v : u, down ? u : v, exitance});
    };
    add(-1.0, 0.0, 0.0, true, 10.0);
    add(0.1, 0.9, 0.5, true, 2.0);
    add(-1.0, 0.0, 2.0, true, 1e-3);
    add(0.2, 0.8, -2.0, false, 50.0);  // turned away
    const Vec3 up(0, 0, 1), y(0, 1, 0);
    panels.push_back({{at(-3.0), 1, 6}, left ? y : up, left ? up : y, 20.0});  // faces x = 1
  }
  return panels;
}

struct FarPair {
  testing::Panels panels;
  CellComplex complex;
  BuildingTree tree;
  BuildingLight light;
  CellSights sights;
  FarField field;
  FarView view;
  Occluders occluders;
  ClusterState receiver;
  WorkCount work;
  std::uint32_t node = 0;  ///< all far panels

  /// The receiver and what stands between are the first cell, the far panels the second.
  static testing::Panels panels_with(std::vector<Panel> between) {
    std::vector<Panel> all{receiving_panel};
    all.insert(all.end(), between.begin(), between.end());
    const std::vector<Panel> far = far_panels();
    all.insert(all.end(), far.begin(), far.end());
    testing::Panels made(all);
    for (std::size_t i = 1 + between.size(); i < all.size(); ++i)
      made.clusters[i].cell = CellId(1u);
    return made;
  }
  explicit FarPair(const std::vector<Panel>& between)
      : panels(panels_with(between)),
        complex(build_cells(plan::two_rooms().pieces(), {})),
        tree(panels.clusters),
        light(tree, panels.scene, panels.clusters),
        sights(complex, panels.clusters),
        field(tree, light, sights),
        view(field, ClusterId(0u)),
        occluders(panels.clusters),
        receiver(panels.clusters[0], panels.scene, Basis::constant) {
    const BuildingTree::Node& root = tree.node(BuildingTree::root);
    node = tree.node(root.left).end - tree.node(root.left).begin == 10u ? root.left : root.right;
    PatchForest& patches = receiver.patches();
    for (std::size_t i = 0; i < patches.size() && patches.size() < 4000; ++i) {
      if (patches.node(i).leaf()) patches.subdivide(i);
    }
  }

  struct Sums {
    double emitted = 0.0;  ///< received power, by what the node emits
    double factor = 0.0;   ///< area times form factor, m2
  };
  Sums estimate(double tolerance) {
    LinkEstimator estimator(occluders, VisibilityMethod::exact, work);
    const FarTerms terms = FarTerms::of(false);
    Sums sums;
    for_each_leaf([&](const PatchNode& leaf) {
      const LinkSide side = LinkSide::of(receiver.patches(), ClusterId(0u), leaf.id);
      const LinkSide far = LinkSide::of(view, node, side);
      const LinkEstimate link = estimator.evaluate(side, far, tolerance, nullptr);
      sums.emitted += side.area_m2 * link.transport[terms.emitted] * light.emitted(node, 0);
      sums.factor += side.area_m2 * link.transport[terms.factor];
    });
    return sums;
  }
  /// As if nothing stood between.
  Sums closed_form() {
    Sums sums;
    for_each_leaf([&](const PatchNode& leaf) {
      const PolygonFrame& frame = receiver.patches().frames()[0];
      const Vec3 x = frame.at(leaf.shape.centroid);
      for (const Cluster& cluster : panels.clusters) {
        if (cluster.cell != CellId(1u)) continue;
        const double factor = point_to_polygon(x, frame.n, cluster.polygons[0].polygon);
        sums.factor += leaf.shape.area_m2 * factor;
        sums.emitted += leaf.shape.area_m2 * factor *
                        panels.scene.surfaces[cluster.polygons[0].surface.index()].exitance[0];
      }
    });
    return sums;
  }
  template <class Take>
  void for_each_leaf(Take take) {
    for (std::size_t i = 0; i < receiver.patches().size(); ++i) {
      if (receiver.patches().node(i).leaf()) take(receiver.patches().node(i));
    }
  }
};

constexpr double by_many_samples = 1e-12, by_one_sample = 1e3;  // tolerances of power

TEST(FarEstimate, WithNothingBetweenThePowerIsThatOfTheClosedForm) {
  FarPair pair({});
  ASSERT_EQ(pair.tree.node(pair.node).polygons, 10u);
  const FarPair::Sums exact = pair.closed_form();
  ASSERT_GT(exact.emitted, 0.1);
  for (const double tolerance : {by_many_samples, by_one_sample}) {
    const FarPair::Sums estimated = pair.estimate(tolerance);
    EXPECT_NEAR(estimated.emitted, exact.emitted, 0.03 * exact.emitted) << tolerance;
    EXPECT_NEAR(estimated.factor, exact.factor, 0.03 * exact.factor) << tolerance;
  }
}

TEST(FarEstimate, AScreenThatHidesHalfHalvesThePower) {
  // In the middle between both sides, up to the plane of symmetry: of each pair of lines that are
  // mirror images, it stops one.
  FarPair pair({{{-20, -20, 3}, {21, 0, 0}, {0, 40, 0}, 0.0}});
  const FarPair::Sums exact = pair.closed_form();
  for (const double tolerance : {by_many_samples, by_one_sample}) {
    const FarPair::Sums estimated = pair.estimate(tolerance);
    EXPECT_NEAR(estimated.emitted, 0.5 * exact.emitted, 0.03 * exact.emitted) << tolerance;
    EXPECT_NEAR(estimated.factor, 0.5 * exact.factor, 0.03 * exact.factor) << tolerance;
  }
}

TEST(FarEstimate, AScreenThatHidesAllLeavesNoPowerButAnError) {
  FarPair pair({{{-20, -20, 3}, {40, 0, 0}, {0, 40, 0}, 0.0}});
  EXPECT_EQ(pair.estimate(by_many_samples).emitted, 0.0);
  LinkEstimator estimator(pair.occluders, VisibilityMethod::exact, pair.work);
  const LinkSide side = LinkSide::of(pair.receiver.patches(), ClusterId(0u), {});
  const LinkEstimate link =
      estimator.evaluate(side, LinkSide::of(pair.view, pair.node, side), by_many_samples, nullptr);
  EXPECT_EQ(link.transport[0], 0.0f);
  EXPECT_GT(link.shooter_error, 0.0);  // rays prove nothing
}

/// A group distributes what it receives by the cosines to the node's middle; their sum is unbiased.
TEST(FarEstimate, AGroupReceivesThePowerOfTheClosedForm) {
  constexpr int groups = 400;
  Scene scene;
  scene.bands = 1;
  std::vector<Cluster> clusters;
  const auto add = [&](const Vec3& corner, const Vec3& u, const Vec3& v, double exitance) {
    Surface surface;
    surface.vertices = {corner, corner + u, corner + u + v, corner + v};
    surface.reflectance = {0.5};
    surface.exitance = {exitance};
    Cluster& cluster = clusters.back();
    cluster.polygons.push_back({SurfaceId(scene.surfaces.size()), surface.vertices});
    cluster.area_m2 += area_m2(surface.vertices);
    cluster.bounds.add(bounds(surface.vertices));
    scene.surfaces.push_back(std::move(surface));
  };
  const auto begin = [&](std::uint32_t cell) {
    clusters.emplace_back();
    clusters.back().id = ClusterId(clusters.size() - 1);
    clusters.back().cell = CellId(cell);
  };
  for (int i = 0; i < groups; ++i) {  // a roof each, and a wall beside it
    begin(0);
    const double x = 0.1 * (i % 20), y = 0.1 * (i / 20);
    add({x, y, 0}, {0.03, 0, 0}, {0, 0.03, 0.01}, 0.0);
    add({x, y + 0.05, -0.03}, {0, 0, 0.02}, {0.03, 0, 0}, 0.0);
  }
  for (int i = 0; i < 4; ++i) {
    begin(1);
    add({0.5 * i, 0.5, 8}, {0, 1, 0}, {0.4, 0, 0}, 1.0 + i);
  }
  const CellComplex complex = build_cells(plan::two_rooms().pieces(), {});
  const BuildingTree tree(clusters);
  const BuildingLight light(tree, scene, clusters);
  const CellSights sights(complex, clusters);
  const FarField field(tree, light, sights);
  const Occluders occluders(clusters);
  const BuildingTree::Node& root = tree.node(BuildingTree::root);
  const std::uint32_t node = tree.node(root.left).polygons == 4u ? root.left : root.right;
  ASSERT_EQ(tree.node(node).polygons, 4u);
  WorkCount work;
  LinkEstimator estimator(occluders, VisibilityMethod::exact, work);
  double estimated = 0.0, exact = 0.0;
  for (int i = 0; i < groups; ++i) {
    const ClusterState receiver(clusters[static_cast<std::size_t>(i)], scene, Basis::constant);
    const FarView view(field, receiver.id());
    Link link;
    link.receiver = receiver.patches().root();
    ASSERT_TRUE(link.receiver.is_group());
    const LinkSide side = LinkSide::of(receiver.patches(), receiver.id(), link.receiver);
    const LinkEstimate estimate =
        estimator.evaluate(side, LinkSide::of(view, node, side), by_many_samples, nullptr);
    for_each_facing(receiver.patches(), link, estimate.transport, [&](std::uint32_t k, double c) {
      estimated += receiver.patches().node(k).shape.area_m2 * c *
                   estimate.transport[FarTerms::of(true).emitted] * light.emitted(node, 0);
    });
    for (std::uint32_t k = 0; k < receiver.patches().polygons(); ++k) {
      const PolygonFrame& frame = receiver.patches().frames()[k];
      const PatchShape& shape = receiver.patches().node(k).shape;
      for (std::size_t s = clusters.size() - 4; s < clusters.size(); ++s) {
        const double factor =
            point_to_polygon(frame.at(shape.centroid), frame.n, clusters[s].polygons[0].polygon);
        exact += shape.area_m2 * factor *
                 scene.surfaces[clusters[s].polygons[0].surface.index()].exitance[0];
      }
    }
  }
  EXPECT_NEAR(estimated, exact, 0.03 * exact);
}

/// Irradiances of the polygons of a receiving group in a room of six surfaces that all emit 1, by
/// one link from the whole. `receiving`: surfaces of the plan, of which the last `unreachable` are
/// marked so.
std::vector<double> received_by_group(const plan::Plan& plan, std::vector<std::size_t> receiving,
                                      std::size_t unreachable) {
  Scene scene = plan.scene();
  scene.bands = 1;
  std::vector<Cluster> clusters(1);
  const auto add = [&](Cluster& cluster, std::size_t i) {
    cluster.polygons.push_back({SurfaceId(i), scene.surfaces[i].vertices});
    cluster.area_m2 += area_m2(scene.surfaces[i].vertices);
    cluster.bounds.add(bounds(scene.surfaces[i].vertices));
    cluster.cell = CellId(0u);
  };
  for (const std::size_t i : receiving) add(clusters[0], i);
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    scene.surfaces[i].exitance = {i < 6 ? 1.0 : 0.0};
    if (std::find(receiving.begin(), receiving.end(), i) == receiving.end())
      add(clusters.emplace_back(), i);
  }
  for (std::size_t i = 0; i < clusters.size(); ++i) clusters[i].id = ClusterId(i);
  const CellComplex complex = build_cells(plan::one_room().pieces(), {});
  const BuildingTree tree(clusters);
  const BuildingLight light(tree, scene, clusters);
  const CellSights sights(complex, clusters);
  const FarField field(tree, light, sights);
  const FarView view(field, ClusterId(0u));
  const Occluders occluders(clusters);
  ClusterState receiver(clusters[0], scene, Basis::constant);
  PatchForest& patches = receiver.patches();
  for (std::size_t k = patches.polygons() - unreachable; k < patches.polygons(); ++k)
    patches.mark_unreachable(k);
  WorkCount work;
  LinkEstimator estimator(occluders, VisibilityMethod::exact, work);
  Link link;
  link.receiver = patches.root();
  const LinkSide side = LinkSide::of(patches, receiver.id(), link.receiver);
  const LinkSide far = LinkSide::of(view, BuildingTree::root, side);
  const LinkEstimate estimate = estimator.evaluate(side, far, by_many_samples, nullptr);
  std::vector<double> received(patches.polygons(), 0.0);
  for_each_facing(patches, link, estimate.transport, [&](std::uint32_t k, double cosine) {
    received[k] += cosine * estimate.transport[FarTerms::of(true).emitted] *
                   light.emitted(BuildingTree::root, 0);
  });
  return received;
}

TEST(FarEstimate, AGroupInANodeReceivesFromAllSides) {
  plan::Plan plan = plan::one_room();
  plan.box({2.4, 1.9, 1.1}, {2.6, 2.1, 1.3}, false);
  for (const double e : received_by_group(plan, {6, 7, 8, 9, 10, 11}, 0)) EXPECT_NEAR(e, 1.0, 0.15);
}

/// The lid of a closed dark box: its upper side receives what its lower side does not.
TEST(FarEstimate, PolygonsThatNoLightReachesTakeNone) {
  plan::Plan plan = plan::one_room();
  plan.box({2.4, 1.9, 1.1}, {2.6, 2.1, 1.3}, true);             // its lid is 9
  plan.rectangle({2.4, 1.9, 1.301}, {0.2, 0, 0}, {0, 0.2, 0});  // 12
  const std::vector<double> received = received_by_group(plan, {12, 9}, 1);
  ASSERT_EQ(received.size(), 2u);
  EXPECT_NEAR(received[0], 1.0, 0.3);
  EXPECT_EQ(received[1], 0.0);
}

/// Rooms beside each other, each with a floor whose one end lies below a bright half of the
/// ceiling: where on the floor a ray starts and where to it goes must not depend on each other.
TEST(FarEstimate, RaysFromAnyPlaceGoAnywhere) {
  constexpr int rooms = 3000;
  plan::Plan plan;
  const auto at = [](int i) { return Vec3(5.0 * (i % 20), 3.0 * (i / 20), 0.0); };
  for (int i = 0; i < rooms; ++i) {
    const Vec3 x(4, 0, 0), y(0, 2, 0), z(0, 0, 2);
    plan.rectangle(at(i), x, y);                      // the floor
    plan.rectangle(at(i) + z, y, 0.5 * x);            // bright
    plan.rectangle(at(i) + z + 0.5 * x, y, 0.5 * x);  // dark, as the walls
    plan.rectangle(at(i), y, z);
    plan.rectangle(at(i), z, x);
    plan.rectangle(at(i) + x, z, y);
    plan.rectangle(at(i) + y, x, z);
  }
  Scene scene = plan.scene();
  scene.bands = 1;
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    scene.surfaces[i].exitance = {i % 7 == 1 ? 1.0 : 0.01};
    Cluster cluster;
    cluster.id = ClusterId(i);
    cluster.cell = CellId(0u);
    cluster.polygons.push_back({SurfaceId(i), scene.surfaces[i].vertices});
    cluster.area_m2 = area_m2(scene.surfaces[i].vertices);
    cluster.bounds = bounds(scene.surfaces[i].vertices);
    clusters.push_back(std::move(cluster));
  }
  const CellComplex complex = build_cells(plan::one_room().pieces(), {});
  const BuildingTree tree(clusters);
  const BuildingLight light(tree, scene, clusters);
  const CellSights sights(complex, clusters);
  const FarField field(tree, light, sights);
  const Occluders occluders(clusters);
  WorkCount work;
  LinkEstimator estimator(occluders, VisibilityMethod::exact, work);
  double estimated = 0.0, exact = 0.0;
  for (std::uint32_t i = 0; i < rooms; ++i) {
    const ClusterId floor(7 * i);
    const FarView view(field, floor);
    const ClusterState receiver(clusters[floor.index()], scene, Basis::constant);
    const LinkSide side = LinkSide::of(receiver.patches(), floor, receiver.patches().root());
    const LinkEstimate estimate = estimator.evaluate(
        side, LinkSide::of(view, BuildingTree::root, side), by_many_samples, nullptr);
    estimated +=
        estimate.transport[FarTerms::of(false).emitted] * light.emitted(BuildingTree::root, 0);
    const Polygon& of = clusters[floor.index()].polygons[0].polygon;
    for (std::uint32_t k = 1; k < 7; ++k) {
      const Polygon& to = clusters[floor.index() + k].polygons[0].polygon;
      double factor = 0.0;
      constexpr int steps = 8;
      for (int a = 0; a < steps * steps; ++a) {
        const Vec3 x = of[0] + (a % steps + 0.5) / steps * (of[1] - of[0]) +
                       (a / steps + 0.5) / steps * (of[3] - of[0]);
        factor += point_to_polygon(x, {0, 0, 1}, to) / (steps * steps);
      }
      exact += factor * scene.surfaces[floor.index() + k].exitance[0];
    }
  }
  EXPECT_NEAR(estimated, exact, 0.025 * exact);
}

TEST(FarEstimate, SamplesAreAsManyAsThePowerIsWorth) {
  FarPair pair({});
  const auto samples = [&](double tolerance) {
    WorkCount work;
    LinkEstimator estimator(pair.occluders, VisibilityMethod::exact, work);
    const LinkSide side = LinkSide::of(pair.receiver.patches(), ClusterId(0u), {});
    estimator.evaluate(side, LinkSide::of(pair.view, pair.node, side), tolerance, nullptr);
    return work.kernels;
  };
  EXPECT_EQ(samples(by_one_sample), 1u);
  const LinkSide side = LinkSide::of(pair.receiver.patches(), ClusterId(0u), {});
  EXPECT_EQ(samples(LinkEstimator::power_bound(side, LinkSide::of(pair.view, pair.node, side))),
            4u);
  EXPECT_EQ(samples(by_many_samples), 16u);
}

}  // namespace
}  // namespace enfilade
