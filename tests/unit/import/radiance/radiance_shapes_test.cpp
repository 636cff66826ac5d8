#include "import/radiance/radiance_shapes.hpp"

#include <numbers>

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

using std::numbers::pi;

RadiancePrimitive shape(const std::string& type, std::vector<double> numbers) {
  RadiancePrimitive primitive;
  primitive.place = {"room.rad", 7};
  primitive.modifier = "grey";
  primitive.type = type;
  primitive.name = "it";
  primitive.numbers = std::move(numbers);
  return primitive;
}

double area_of(const std::vector<Polygon>& polygons) {
  double sum = 0.0;
  for (const Polygon& polygon : polygons) sum += area_m2(polygon);
  return sum;
}

// Every polygon faces away from the point (1), or towards it (-1); 0 for neither.
int facing_from(const std::vector<Polygon>& polygons, const Vec3& inside) {
  int out = 0;
  for (const Polygon& p : polygons) out += plane_of(p).signed_distance(inside) < 0.0 ? 1 : -1;
  return out / static_cast<int>(polygons.size());
}

void expect_flat(const std::vector<Polygon>& polygons) {
  for (const Polygon& polygon : polygons) {
    const Plane plane = plane_of(polygon);
    for (const Vec3& p : polygon) EXPECT_LT(std::abs(plane.signed_distance(p)), 1e-12);
  }
}

TEST(RadianceShapes, PolygonIsTakenAsItIs) {
  const auto polygons = radiance_polygons(shape("polygon", {0, 0, 1, 2, 0, 1, 0, 3, 1}));
  ASSERT_EQ(polygons.size(), 1u);
  EXPECT_EQ(polygons[0][2], Vec3(0, 3, 1));
  EXPECT_NEAR(area_m2(polygons[0]), 3.0, 1e-15);
}

TEST(RadianceShapes, RingHasTheAreaOfTheRealOne) {
  const auto disk = radiance_polygons(shape("ring", {1, 2, 3, 0, 0, -5, 0, 0.5}));
  ASSERT_EQ(disk.size(), 1u);
  EXPECT_EQ(disk[0].size(), 24u);
  EXPECT_NEAR(area_of(disk), pi * 0.25, 1e-12);
  EXPECT_NEAR(normal(disk[0]).z, -1.0, 1e-12);
  EXPECT_LT(glm::length(centroid(disk[0]) - Vec3(1, 2, 3)), 1e-12);
  const auto ring = radiance_polygons(shape("ring", {0, 0, 0, 1, 1, 0, 2, 1}));  // either order
  EXPECT_EQ(ring.size(), 24u);
  EXPECT_NEAR(area_of(ring), 3.0 * pi, 1e-12);
  for (const Polygon& p : ring)
    EXPECT_LT(glm::length(normal(p) - glm::normalize(Vec3(1, 1, 0))), 1e-9);
}

TEST(RadianceShapes, CylinderFacesOutwardAndTubeInward) {
  const std::vector<double> numbers{1, 1, 1, 1, 1, 3, 0.5};
  const auto cylinder = radiance_polygons(shape("cylinder", numbers));
  EXPECT_EQ(cylinder.size(), 24u);
  EXPECT_NEAR(area_of(cylinder) / (2.0 * pi * 0.5 * 2.0), 1.0, 0.003);
  EXPECT_EQ(facing_from(cylinder, {1, 1, 2}), 1);
  EXPECT_EQ(facing_from(radiance_polygons(shape("tube", numbers)), {1, 1, 2}), -1);
}

TEST(RadianceShapes, ConeToAPointIsOfTriangles) {
  const std::vector<double> numbers{0, 0, 0, 0, 0, 4, 3, 0};
  const auto cone = radiance_polygons(shape("cone", numbers));
  EXPECT_EQ(cone.size(), 24u);
  for (const Polygon& p : cone) EXPECT_EQ(p.size(), 3u);
  EXPECT_NEAR(area_of(cone) / (pi * 3.0 * 5.0), 1.0, 0.006);
  EXPECT_EQ(facing_from(cone, {0, 0, 1}), 1);
  EXPECT_EQ(facing_from(radiance_polygons(shape("cup", numbers)), {0, 0, 1}), -1);
  const auto blunt = radiance_polygons(shape("cone", {0, 0, 0, 3, 4, 0, 2, 1}));
  expect_flat(blunt);
  EXPECT_EQ(facing_from(blunt, {1, 1.5, 0}), 1);
}

TEST(RadianceShapes, ACapFitsItsPipeWhicheverWayItPoints) {
  const auto pipe = radiance_polygons(shape("cylinder", {0, 0, 0, 1, 2, 3, 0.5}));
  for (const double way : {1.0, -1.0}) {
    const auto cap = radiance_polygons(shape("ring", {0, 0, 0, way, 2 * way, 3 * way, 0, 0.5}));
    for (const Polygon& side : pipe) {
      double nearest = 1.0;
      for (const Vec3& p : cap[0]) nearest = std::min(nearest, glm::length(p - side[0]));
      EXPECT_LT(nearest, 1e-12);
    }
  }
}

TEST(RadianceShapes, SphereHasTheAreaOfTheRealOne) {
  const auto sphere = radiance_polygons(shape("sphere", {1, 2, 3, 2}));
  EXPECT_EQ(sphere.size(), 128u);
  EXPECT_NEAR(area_of(sphere), 16.0 * pi, 1e-10);
  EXPECT_EQ(facing_from(sphere, {1, 2, 3}), 1);
  EXPECT_EQ(facing_from(radiance_polygons(shape("bubble", {1, 2, 3, 2})), {1, 2, 3}), -1);
  expect_flat(sphere);
}

TEST(RadianceShapes, WhatHasNoAreaIsRefused) {
  const auto fault = [](const std::string& type, std::vector<double> numbers) {
    return input_error([&] { radiance_polygons(shape(type, std::move(numbers))); });
  };
  EXPECT_THAT(fault("polygon", {0, 0, 0, 1, 0, 0}),
              HasSubstr("room.rad: line 7: polygon \"it\" has 6 numbers; write"));
  EXPECT_THAT(fault("polygon", {0, 0, 0, 1, 0, 0, 1, 1, 0, 5}), HasSubstr("has 10 numbers"));
  EXPECT_THAT(fault("sphere", {0, 0, 0}), HasSubstr("has 3 numbers, not 4"));
  EXPECT_THAT(fault("sphere", {0, 0, 0, -1}), HasSubstr("radius"));
  EXPECT_THAT(fault("ring", {0, 0, 0, 0, 0, 1, 2, 2}), HasSubstr("no area"));
  EXPECT_THAT(fault("ring", {0, 0, 0, 0, 0, 0, 0, 2}), HasSubstr("axis of no length"));
  EXPECT_THAT(fault("cylinder", {1, 1, 1, 1, 1, 1, 2}), HasSubstr("axis of no length"));
  EXPECT_THAT(fault("cone", {0, 0, 0, 0, 0, 1, 0, 0}), HasSubstr("no area"));
  EXPECT_EQ(fault("cone", {0, 0, 0, 0, 0, 1, 0, 1}), "");
}

}  // namespace
}  // namespace enfilade
