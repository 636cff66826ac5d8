#include "radiosity/visible_parts.hpp"

#include <gtest/gtest.h>

#include "box_room.hpp"

namespace enfilade {
namespace {

const Polygon lamp{{0, 0, 3}, {0, 1, 3}, {1, 1, 3}, {1, 0, 3}};  // faces down

double area_seen(const Vec3& x, const std::vector<Polygon>& others) {
  Scene scene;
  for (const Polygon& p : others) {
    Surface s;
    s.vertices = p;
    s.reflectance = s.exitance = {0.0};
    scene.surfaces.push_back(s);
  }
  const Occluders occluders(testing::clusters_of(scene));
  std::vector<std::uint32_t> between;
  EXPECT_TRUE(
      occluders.find_between({x}, lamp, RayScene::no_polygon, RayScene::no_polygon, 8, between));
  VisibleParts parts;
  parts.begin(x, lamp, occluders.tolerance_m());
  for (const std::uint32_t k : between) EXPECT_TRUE(parts.hide(occluders.polygon(k)));
  double sum = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Polygon part(parts[i].begin(), parts[i].end());
    EXPECT_LT(normal(part).z, 0.0);
    sum += area_m2(part);
  }
  return sum;
}

TEST(VisibleParts, AShadowIsCutOutWithItsExactArea) {
  // Half way up, a square of side 0.2 has a shadow of side 0.4.
  const Vec3 x(0.5, 0.5, 0.0);
  const Polygon square{{0.4, 0.4, 1.5}, {0.6, 0.4, 1.5}, {0.6, 0.6, 1.5}, {0.4, 0.6, 1.5}};
  EXPECT_NEAR(area_seen(x, {square}), 1.0 - 0.16, 1e-12);
  const Polygon turned(square.rbegin(), square.rend());
  EXPECT_NEAR(area_seen(x, {square, turned}), 1.0 - 0.16, 1e-12) << "two sides, one shadow";
}

TEST(VisibleParts, ThinBladesHideWhatTheyHide) {
  // A blade from z = 1 to 2 in the plane x = 0.4, seen from x = 0.5: its shadow is 0.2 to 0.35.
  const Polygon blade{{0.4, -1, 1}, {0.4, 2, 1}, {0.4, 2, 2}, {0.4, -1, 2}};
  EXPECT_NEAR(area_seen({0.5, 0.5, 0.0}, {blade}), 0.85, 1e-12);
  EXPECT_NEAR(area_seen({0.4, 0.5, 0.0}, {blade}), 1.0, 1e-12) << "edge-on";
}

TEST(VisibleParts, AWallThroughTheLampHidesWhatLiesBeyondIt) {
  const Polygon wall{{0.5, -1, 1}, {0.5, 2, 1}, {0.5, 2, 4}, {0.5, -1, 4}};
  EXPECT_NEAR(area_seen({0.2, 0.5, 0.0}, {wall}), 0.65, 1e-12);  // lit again where it sees below
  const Polygon whole{{0.5, -1, 0}, {0.5, 2, 0}, {0.5, 2, 4}, {0.5, -1, 4}};
  EXPECT_NEAR(area_seen({0.2, 0.5, 0.0}, {whole}), 0.5, 1e-12);
}

TEST(VisibleParts, BehindACoverThereIsNone) {
  const Polygon cover{{-1, -1, 1}, {2, -1, 1}, {2, 2, 1}, {-1, 2, 1}};
  EXPECT_EQ(area_seen({0.5, 0.5, 0.0}, {cover}), 0.0);
  const Polygon above{{-1, -1, 4}, {2, -1, 4}, {2, 2, 4}, {-1, 2, 4}};
  EXPECT_NEAR(area_seen({0.5, 0.5, 0.0}, {above}), 1.0, 1e-12);
}

}  // namespace
}  // namespace enfilade
