#include "geometry/triangulation.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

double area_of(const Triangulation& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec2 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const double area = 0.5 * cross2(b - a, c - a);
    EXPECT_GT(area, 0.0);
    sum += area;
  }
  return sum;
}

TEST(Triangulate, CoversAnLShapeWithItsOwnPoints) {
  const std::vector<Vec2> ring{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const Triangulation mesh = triangulate(ring, 1e-9);
  ASSERT_TRUE(mesh.simple);
  EXPECT_EQ(mesh.points, ring);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_NEAR(area_of(mesh), 3.0, 1e-12);
}

TEST(Triangulate, AHoleJoinedByACutStaysOpen) {
  const std::vector<Vec2> ring{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0},
                               {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}};
  const Triangulation mesh = triangulate(ring, 1e-9);
  ASSERT_TRUE(mesh.simple);
  EXPECT_NEAR(area_of(mesh), 8.0, 1e-12);
}

TEST(Triangulate, ARingThatCrossesItselfIsNotSimple) {
  EXPECT_FALSE(triangulate({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, 1e-9).simple);
}

}  // namespace
}  // namespace enfilade
