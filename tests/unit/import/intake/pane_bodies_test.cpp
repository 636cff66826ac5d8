#include "import/intake/pane_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/geometry/box_faces.hpp"

namespace enfilade {
namespace {

using test::box_faces;

/// Faces that look outward, of glass that passes 0.64 in all.
std::vector<Surface> glass(const std::vector<Polygon>& faces) {
  std::vector<Surface> surfaces;
  for (const Polygon& face : faces) {
    Surface& surface = surfaces.emplace_back();
    surface.vertices = face;
    surface.transmittance = {0.64};
  }
  return surfaces;
}
std::vector<Polygon> solid(const Vec3& lo, const Vec3& hi) { return box_faces(lo, hi, false); }

TEST(PaneBodies, AThinSolidIsOnePane) {
  std::vector<Surface> surfaces = glass(solid({0, 0, 0}, {2.0, 0.006, 1.0}));
  merge_pane_bodies(surfaces, 0);
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_NEAR(area_m2(surfaces[0].vertices), 2.0, 1e-12);
  EXPECT_EQ(surfaces[0].transmittance[0], 0.64);
}

TEST(PaneBodies, SidesMayBeCutDifferently) {
  std::vector<Polygon> faces = solid({0, 0, 0}, {2.0, 0.006, 1.0});
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (normal(faces[i]).y < 0.9) continue;
    const Polygon whole = faces[i];
    faces[i] = {whole[0], whole[1], whole[2]};
    faces.push_back({whole[0], whole[2], whole[3]});
    break;
  }
  std::vector<Surface> surfaces = glass(faces);
  merge_pane_bodies(surfaces, 0);
  double area = 0.0;
  for (const Surface& surface : surfaces) {
    area += area_m2(surface.vertices);
    EXPECT_EQ(surface.transmittance[0], 0.64);
  }
  EXPECT_NEAR(area, 2.0, 1e-12);
}

TEST(PaneBodies, DoubleGlazingIsTwoPanes) {
  std::vector<Polygon> faces = solid({0, 0, 0}, {1.5, 0.004, 1.0});
  for (const Polygon& face : solid({0, 0.020, 0}, {1.5, 0.024, 1.0})) faces.push_back(face);
  std::vector<Surface> surfaces = glass(faces);
  merge_pane_bodies(surfaces, 0);
  ASSERT_EQ(surfaces.size(), 2u);
  const double apart = surfaces[1].vertices[0].y - surfaces[0].vertices[0].y;
  EXPECT_GT(std::abs(apart), 0.015);  // one of each, not both sides of the gap
  for (const Surface& surface : surfaces) EXPECT_EQ(surface.transmittance[0], 0.64);
}

TEST(PaneBodies, ABlockOfGlassKeepsItsFaces) {
  std::vector<Surface> surfaces = glass(solid({0, 0, 0}, {0.2, 0.1, 0.2}));
  merge_pane_bodies(surfaces, 0);
  ASSERT_EQ(surfaces.size(), 6u);
  for (const Surface& surface : surfaces) EXPECT_NEAR(surface.transmittance[0], 0.8, 1e-12);
}

TEST(PaneBodies, SurfacesBeforeStayAsTheyAre) {
  std::vector<Surface> surfaces = glass(solid({0, 0, 0}, {1, 1, 1}));
  for (const Surface& surface : glass(solid({0, 0, 5}, {2.0, 1.0, 5.01})))
    surfaces.push_back(surface);
  merge_pane_bodies(surfaces, 6);
  ASSERT_EQ(surfaces.size(), 7u);
  for (const Surface& surface : surfaces) EXPECT_EQ(surface.transmittance[0], 0.64);
}

}  // namespace
}  // namespace enfilade
