#include "links/link_estimate.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/form_factor.hpp"
#include "unit/gather/box_room.hpp"
#include "unit/links/sheet.hpp"

namespace enfilade {
namespace {

using testing::sheet;

/// The link from a unit square at height 1 to the unit square below it, past some occluders.
struct Pair {
  Scene scene;
  std::vector<Cluster> clusters;
  Occluders occluders;
  ClusterState receiving, shooting;
  WorkCount work;
  LinkEstimate estimate;
  LinkEstimator::Between between;

  Pair(std::vector<Surface> occluding, double tolerance, Basis basis = Basis::constant,
       VisibilityMethod method = VisibilityMethod::exact)
      : scene(scene_with(std::move(occluding))),
        clusters(testing::clusters_of(scene)),
        occluders(clusters),
        receiving(clusters[0], scene, basis),
        shooting(clusters[1], scene, basis) {
    LinkEstimator estimator(occluders, method, work);
    estimate =
        estimator.evaluate(LinkSide::of(receiving.patches(), ClusterId(0u), {}),
                           LinkSide::of(shooting.patches(), ClusterId(1u), {}), tolerance, nullptr);
    between = estimator.between();
  }
  static Scene scene_with(std::vector<Surface> occluding) {
    Scene scene;
    scene.bands = 1;
    scene.surfaces = std::move(occluding);
    scene.surfaces.insert(scene.surfaces.begin(),
                          {sheet({0, 0}, {1, 1}, 0, true), sheet({0, 0}, {1, 1}, 1, false)});
    return scene;
  }
};

/// Parallel unit squares at distance 1.
constexpr double square_factor = 0.19982;
constexpr double exactly = 1e-9, roughly = 1.0;  // tolerances of power

TEST(LinkEstimator, AnOpenPairNeedsNoRay) {
  const Pair pair({}, exactly);
  EXPECT_NEAR(pair.estimate.transport[0], square_factor, 2e-3);
  EXPECT_EQ(pair.work.rays, 0u);
  EXPECT_EQ(pair.estimate.shooter_error, 0.0);
  ASSERT_NE(pair.between, nullptr);
  EXPECT_TRUE(pair.between->empty());
}

TEST(LinkEstimator, APolygonThatHidesAllProvesThePairShut) {
  const Pair pair({sheet({-1, -1}, {2, 2}, 0.5, true)}, exactly);
  EXPECT_EQ(pair.estimate.transport[0], 0.0f);
  EXPECT_EQ(pair.estimate.receiver_error, 0.0);
  EXPECT_EQ(pair.estimate.shooter_error, 0.0);
  EXPECT_EQ(pair.work.rays, 0u);
}

TEST(LinkEstimator, PartialVisibilityIsExactWithoutRays) {
  // The sheet hides the half x < 1/2 of the middle plane: by symmetry half of the power is left.
  const Pair pair({sheet({-1, -1}, {0.5, 2}, 0.5, true)}, exactly);
  EXPECT_NEAR(pair.estimate.transport[0], 0.5 * square_factor, 4e-3);
  EXPECT_GT(pair.estimate.receiver_error, 0.0);
  EXPECT_EQ(pair.work.rays, 0u);
}

TEST(LinkEstimator, AThinBarBetweenTheRaysCounts) {
  const Pair pair({sheet({0.5, -1}, {0.52, 2}, 0.5, true)}, exactly);
  EXPECT_LT(pair.estimate.transport[0] - pair.estimate.receiver_error, square_factor - 1e-3);
  EXPECT_EQ(pair.work.rays, 0u);
}

TEST(LinkEstimator, RaysAreAsManyAsThePowerIsWorth) {
  const std::vector<Surface> half{sheet({-1, -1}, {0.5, 2}, 0.5, true)};
  EXPECT_EQ(Pair(half, 10.0 * roughly).work.rays, 1u);
  EXPECT_EQ(Pair(half, 0.2 * roughly).work.rays, 4u);
  const Pair many(half, exactly, Basis::constant, VisibilityMethod::rays);
  EXPECT_EQ(many.work.rays, 16u);
  EXPECT_NEAR(many.estimate.transport[0], 0.5 * square_factor, 0.06);
  EXPECT_GT(many.estimate.shooter_error, 0.0);
}

TEST(LinkEstimator, WhatALinkCarriesDoesNotDependOnTheRaysThatDecided) {
  // From a point at x the share x of the shooter is seen, past the edge at x = 1/2 of the middle
  // plane. A part of the receiver whose only ray is shut still carries that share, on average.
  const Pair pair({sheet({-1, -1}, {0.5, 2}, 0.5, true)}, exactly);
  WorkCount work;
  LinkEstimator estimator(pair.occluders, VisibilityMethod::exact, work);
  const LinkSide shooter = LinkSide::of(pair.shooting.patches(), ClusterId(1u), {});
  double kept = 0.0, expected = 0.0;
  constexpr std::uint32_t parts = 1024;
  for (std::uint32_t path = parts; path < 2 * parts; ++path) {
    const LinkSide part = LinkSide::of(pair.receiving.patches(), ClusterId(0u), {0, path});
    const LinkEstimate decided = estimator.evaluate(part, shooter, roughly, nullptr);
    if (decided.transport[0] > 0.0f) continue;
    const auto transport = estimator.kept(part, shooter, roughly, nullptr, decided).transport;
    kept += transport[0];
    Polygon corners = shooter.corners;
    expected += part.center.x * point_to_polygon(part.center, {0, 0, 1}, corners);
  }
  EXPECT_GT(expected, 20.0);
  EXPECT_NEAR(kept / expected, 1.0, 0.25);
}

TEST(LinkEstimator, SidesThatFaceAwayAreInvisible) {
  const Pair pair({}, exactly);
  const LinkSide up = LinkSide::of(pair.receiving.patches(), ClusterId(0u), {});
  EXPECT_FALSE(
      LinkEstimator::faces_away(up, LinkSide::of(pair.shooting.patches(), ClusterId(1u), {})));
  EXPECT_TRUE(LinkEstimator::faces_away(up, up));
}

}  // namespace
}  // namespace enfilade
