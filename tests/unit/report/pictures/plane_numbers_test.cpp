#include "report/pictures/plane_numbers.hpp"

#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

std::vector<std::uint32_t> numbers_of(const std::vector<Polygon>& polygons) {
  Scene scene;
  for (const Polygon& polygon : polygons) {
    Surface surface;
    surface.vertices = polygon;
    surface.reflectance = surface.exitance = {0.0};
    scene.surfaces.push_back(surface);
  }
  const std::vector<Cluster> clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  const CellComplex cells;
  std::vector<ClusterState> states;
  for (const Cluster& c : clusters) states.emplace_back(c, scene, Basis::constant);
  const std::vector<std::uint32_t> of_pieces =
      plane_numbers({scene, cells, clusters, states, occluders}, 1e-4);
  // By the surface that each piece is of.
  std::vector<std::uint32_t> numbers(polygons.size());
  std::size_t piece = 0;
  for (const Cluster& c : clusters) {
    for (const auto& of : c.polygons) numbers[of.surface.index()] = of_pieces.at(piece++);
  }
  return numbers;
}

/// A square that faces up, or down, in the plane through (0, 0, z) that rises by `slope` along x.
Polygon square(double x, double z, bool up = true, double slope = 0.0) {
  Polygon corners{{x, 0, z}, {x + 1, 0, z}, {x + 1, 1, z}, {x, 1, z}};
  for (Vec3& p : corners) p.z += slope * p.x;
  if (!up) std::ranges::reverse(corners);
  return corners;
}

TEST(PlaneNumbers, TellPlanesAndSidesApart) {
  const auto n = numbers_of({square(0, 0), square(5, 0), square(0, 0.01), square(2, 0, false),
                             square(9, 0.01), square(3, 0, true, 0.01), square(7, 0, true, 0.01)});
  EXPECT_EQ(n[0], n[1]);
  EXPECT_EQ(n[2], n[4]);
  EXPECT_EQ(n[5], n[6]) << "inclined planes, by their offset";
  EXPECT_NE(n[0], n[2]) << "a sheet a centimetre above";
  EXPECT_NE(n[0], n[3]) << "the other side";
  EXPECT_NE(n[0], n[5]) << "another inclination";
}

TEST(PlaneNumbers, AreFoundFarFromTheOrigin) {
  // The normal's rounding, times such a distance, is more than the tolerance.
  std::vector<Polygon> polygons{square(0, 0, true, 1.0 / 3.0), square(5, 0, true, 1.0 / 3.0)};
  for (Polygon& polygon : polygons) {
    for (Vec3& p : polygon) p += Vec3(4e6, 5e6, 100.0);
  }
  const auto n = numbers_of(polygons);
  EXPECT_EQ(n[0], n[1]);
}

}  // namespace
}  // namespace enfilade
