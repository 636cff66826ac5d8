#include "clusters/unreachable_parts.hpp"

#include <gtest/gtest.h>

#include <map>

#include "cells/rooms/build_cells.hpp"
#include "clusters/cluster.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"

namespace enfilade {
namespace {

/// A lit room of 5 x 4 x 2.5, and what a test puts into it. The floor is surface 0.
plan::Plan room() { return plan::one_room(); }

/// The ceiling (surface 3) gives the light.
Scene lit(const plan::Plan& plan) {
  Scene scene = plan.scene();
  scene.surfaces[3].exitance = {1.0};
  return scene;
}

struct Cut {
  std::vector<CellPiece> before, after;
  double unreachable_m2(std::size_t surface) const {
    double sum = 0.0;
    for (const CellPiece& p : after) {
      if (p.unreachable && p.piece.surface.index() == surface) sum += area_m2(p.piece.polygon);
    }
    return sum;
  }
  std::size_t parts(std::size_t surface) const {
    return static_cast<std::size_t>(
        std::count_if(after.begin(), after.end(),
                      [&](const CellPiece& p) { return p.piece.surface.index() == surface; }));
  }
};

Cut cut(const Scene& scene, const UnreachableConfig& config = {}) {
  Warnings warnings;
  const std::vector<Piece> pieces = make_pieces(scene, warnings);
  const CellComplex complex = build_cells(pieces, {});
  Cut cut;
  for (const Piece& piece : pieces) {
    for (CellPiece& part : complex.cut(piece)) cut.before.push_back(std::move(part));
  }
  cut.after = cut_unreachable_parts(scene, cut.before, complex.tolerance_m(), config);
  return cut;
}

void expect_same_area(const Cut& cut) {
  std::map<std::pair<SurfaceId, CellId>, double> area;
  for (const CellPiece& p : cut.before) area[{p.piece.surface, p.cell}] += area_m2(p.piece.polygon);
  for (const CellPiece& p : cut.after) area[{p.piece.surface, p.cell}] -= area_m2(p.piece.polygon);
  for (const auto& [key, difference] : area) EXPECT_NEAR(difference, 0.0, 1e-9);
}

TEST(UnreachableParts, WithoutStepsLeftAllIsReachableAndWhole) {
  plan::Plan plan = room();
  plan.box({1, 1, -0.01}, {1.8, 1.6, 0.9}, false);
  UnreachableConfig config;
  config.free_steps = config.steps_per_piece = 0;
  const Cut result = cut(lit(plan), config);
  EXPECT_EQ(result.after.size(), result.before.size());
  for (const CellPiece& piece : result.after) EXPECT_FALSE(piece.unreachable);
}

TEST(UnreachableParts, FloorUnderABoxIsUnreachableAndSeparate) {
  // Coplanar with the floor, and sunk 1 cm into it.
  for (const double bottom : {0.0, -0.01}) {
    plan::Plan plan = room();
    plan.box({1, 1, bottom}, {1.8, 1.6, 0.9}, false);
    const Cut result = cut(lit(plan));
    expect_same_area(result);
    EXPECT_NEAR(result.unreachable_m2(0), 0.8 * 0.6, 1e-9) << bottom;
    EXPECT_GE(result.parts(0), 5u);  // the ground around a hole, and the hole
    EXPECT_LE(result.parts(0), 7u);
    for (const CellPiece& p : result.after) {
      if (p.piece.surface.index() != 0) continue;
      // Each part lies on one side of the box's outline.
      const Vec3 c = centroid(p.piece.polygon);
      EXPECT_EQ(p.unreachable, c.x > 1 && c.x < 1.8 && c.y > 1 && c.y < 1.6);
    }
  }
}

TEST(UnreachableParts, SidesOfABoxAreCutWhereTheySinkIn) {
  plan::Plan plan = room();
  plan.box({1, 1, -0.5}, {1.8, 1.6, 0.9}, false);
  plan.box({-0.5, -0.5, -0.6}, {5.5, 4.5, 0.0}, false);  // the slab below
  const Cut result = cut(lit(plan));
  expect_same_area(result);
  double unreachable = 0.0;
  for (std::size_t s = 6; s < 12; ++s) unreachable += result.unreachable_m2(s);
  EXPECT_NEAR(unreachable, 0.5 * 2.8 + 0.8 * 0.6, 1e-9);
}

TEST(UnreachableParts, OnlyTheFootprintsOfATableAreUnreachable) {
  plan::Plan plan = room();
  for (const double x : {1.0, 2.1}) {
    for (const double y : {1.0, 1.7}) plan.box({x, y, 0}, {x + 0.05, y + 0.05, 0.7}, false);
  }
  plan.box({0.95, 0.95, 0.7}, {2.2, 1.8, 0.73}, false);
  const Cut result = cut(lit(plan));
  expect_same_area(result);
  EXPECT_NEAR(result.unreachable_m2(0), 4 * 0.05 * 0.05, 1e-9);
  // Where the legs meet the top.
  double under_top = 0.0;
  for (std::size_t s = 30; s < 36; ++s) under_top += result.unreachable_m2(s);
  EXPECT_NEAR(under_top, 4 * 0.05 * 0.05, 1e-9);
}

TEST(UnreachableParts, AnEmptyRoomIsNotCut) {
  for (const plan::Plan& plan : {plan::one_room(), plan::two_rooms()}) {
    const Cut result = cut(lit(plan));
    ASSERT_EQ(result.after.size(), result.before.size());
    for (std::size_t i = 0; i < result.after.size(); ++i) {
      EXPECT_FALSE(result.after[i].unreachable);
      EXPECT_EQ(result.after[i].piece.polygon, result.before[i].piece.polygon);
    }
  }
}

TEST(UnreachableParts, ALampWithoutExtentLightsToo) {
  plan::Plan plan = room();
  plan.box({1, 1, 0}, {1.8, 1.6, 0.9}, false);
  Scene scene = plan.scene();
  scene.lights.push_back({{3, 2, 2}, {100.0}});
  EXPECT_NEAR(cut(scene).unreachable_m2(0), 0.8 * 0.6, 1e-9);
}

TEST(UnreachableParts, PlaceAndDirectionDoNotMatter) {
  const auto count = [](bool moved) {
    plan::Plan plan = room();
    plan.box({1, 1, 0}, {1.8, 1.6, 0.9}, false);
    plan.box({3, 2, -0.01}, {3.4, 2.4, 0.5}, false);
    if (moved) {
      const double c = std::cos(0.7), s = std::sin(0.7);
      plan.transform([&](const Vec3& p) {
        const Vec3 q(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
        return Vec3(q.x, c * q.y - s * q.z, s * q.y + c * q.z) + Vec3(1000, -2000, 500);
      });
    }
    return cut(lit(plan));
  };
  const Cut here = count(false), there = count(true);
  EXPECT_NEAR(here.unreachable_m2(0), 0.48 + 0.16, 1e-9);
  EXPECT_NEAR(there.unreachable_m2(0), 0.48 + 0.16, 1e-6);
  EXPECT_EQ(here.parts(0), there.parts(0));
}

TEST(UnreachableParts, TheBoundOnPartsHoldsAndLosesNothing) {
  plan::Plan plan = room();
  for (int i = 0; i < 10; ++i) {
    const Vec3 lo(0.3 + 0.4 * i, 0.5 + 0.3 * i, 0);
    plan.box(lo, lo + Vec3(0.2, 0.2, 0.4), false);
  }
  UnreachableConfig config;
  config.max_parts = 4;
  const Cut result = cut(lit(plan), config);
  expect_same_area(result);
  EXPECT_LE(result.parts(0), 4u);
  EXPECT_NEAR(cut(lit(plan)).unreachable_m2(0), 10 * 0.04, 1e-9);
}

TEST(UnreachableParts, NoClusterMixesReachableAndUnreachable) {
  plan::Plan plan = room();
  plan.box({1, 1, 0}, {1.8, 1.6, 0.9}, false);
  const Scene scene = lit(plan);
  const Cut result = cut(scene);
  std::size_t of_floor = 0;
  for (const Cluster& cluster : build_clusters(scene, result.after, {})) {
    for (const ClusterPolygon& polygon : cluster.polygons) {
      if (polygon.surface.index() != 0) continue;
      ++of_floor;
      const Vec3 c = centroid(polygon.polygon);
      const bool unreachable = c.x > 1 && c.x < 1.8 && c.y > 1 && c.y < 1.6;
      EXPECT_EQ(cluster.polygons.size() == 1, unreachable);
    }
  }
  EXPECT_EQ(of_floor, result.parts(0));
}

}  // namespace
}  // namespace enfilade
