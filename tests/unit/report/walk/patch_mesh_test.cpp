#include "report/walk/patch_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

double area_of(const PatchMesh& mesh, const PatchMesh::Face& face) {
  double twice = 0.0;
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const Vec2 a = mesh.points[face.corners[i]];
    const Vec2 b = mesh.points[face.corners[(i + 1) % face.corners.size()]];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

TEST(PatchMesh, FacesAreTheLeavesAndMeetAtAllCorners) {
  test::LitRooms rooms;
  PatchForest& forest = rooms.states[0].patches();
  // Halves of halves at one end, so that small patches lie beside large ones.
  std::size_t node = 0;
  for (int i = 0; i < 7; ++i) {
    forest.subdivide(node);
    node = forest.node(node).child(i % 2);
  }
  const auto leaves = leaves_by_polygon(forest);
  ASSERT_EQ(leaves[0].size(), 8u);
  ASSERT_EQ(leaves[1].size(), 1u);
  const PatchMesh mesh = patch_mesh(forest, 0, leaves[0]);
  std::set<std::pair<long, long>> places;
  for (const Vec2& p : mesh.points)
    EXPECT_TRUE(places.insert({std::lround(1e5 * p.x), std::lround(1e5 * p.y)}).second);
  std::size_t hanging = 0;
  for (const PatchMesh::Face& face : mesh.faces) {
    const PatchShape& shape = forest.node(face.node).shape;
    EXPECT_NEAR(area_of(mesh, face), shape.area_m2, 1e-9);
    hanging += face.corners.size() - shape.vertices.size();
    // Every point on the border of the leaf is a corner of its face.
    for (std::uint32_t i = 0; i < mesh.points.size(); ++i) {
      double nearest_m = 1e30;
      for (std::size_t k = 0; k < shape.vertices.size(); ++k) {
        const Vec2 a = shape.vertices[k], b = shape.vertices[(k + 1) % shape.vertices.size()];
        const double t =
            std::clamp(glm::dot(mesh.points[i] - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
        nearest_m = std::min(nearest_m, glm::length(mesh.points[i] - a - t * (b - a)));
      }
      const bool corner = std::ranges::count(face.corners, i) == 1;
      EXPECT_EQ(corner, nearest_m < 1e-6) << "point " << i << " of face " << face.node;
    }
  }
  EXPECT_GT(hanging, 0u) << "the test needs corners on the edges of others";
}

}  // namespace
}  // namespace enfilade
