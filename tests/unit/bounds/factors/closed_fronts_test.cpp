#include "bounds/factors/closed_fronts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/geometry/box_faces.hpp"

namespace enfilade {
namespace {

/// The six sides of a box, their fronts inside, or outside where `solid`.
std::vector<Polygon> box(const Vec3& lo, const Vec3& hi, bool solid = false) {
  return test::box_faces(lo, hi, !solid);
}

std::size_t closed(std::vector<Polygon> polygons) {
  const ClosedFronts found = closed_fronts(polygons, {}, 1e-6);
  return static_cast<std::size_t>(std::count(found.polygons.begin(), found.polygons.end(), 1));
}

std::vector<Polygon> joined(std::vector<Polygon> a, const std::vector<Polygon>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(ClosedFronts, ARoomIsClosed) { EXPECT_EQ(closed(box(Vec3(0), Vec3(4, 5, 3))), 6u); }

TEST(ClosedFronts, ARoomWithABlockInTheAirIsClosed) {
  EXPECT_EQ(closed(joined(box(Vec3(0), Vec3(4)), box(Vec3(1), Vec3(2), true))), 12u);
}

TEST(ClosedFronts, ASideMadeOfPartsWithAnEdgeMoreIsClosed) {
  std::vector<Polygon> room = box(Vec3(0), Vec3(2));
  room[0] = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}};
  room.push_back({{1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}});
  EXPECT_EQ(closed(room), 7u);
}

TEST(ClosedFronts, ARoomWithoutASideIsOpen) {
  std::vector<Polygon> room = box(Vec3(0), Vec3(2));
  room.pop_back();
  EXPECT_EQ(closed(room), 0u);
}

TEST(ClosedFronts, ASlitIsFound) {
  std::vector<Polygon> room = box(Vec3(0), Vec3(2));
  for (Vec3& p : room[1]) p.x = std::min(p.x, 1.999);
  EXPECT_EQ(closed(room), 0u);
}

TEST(ClosedFronts, ASideThatFacesOutIsFound) {
  std::vector<Polygon> room = box(Vec3(0), Vec3(2));
  std::reverse(room[3].begin(), room[3].end());
  EXPECT_EQ(closed(room), 0u);
}

TEST(ClosedFronts, ABlockThroughAWallIsNotTakenForClosed) {
  EXPECT_EQ(closed(joined(box(Vec3(0), Vec3(4)), box(Vec3(3, 1, 1), Vec3(5, 2, 2), true))), 0u);
}

TEST(ClosedFronts, ABlockOnTheFloorHidesWhatIsBelowIt) {
  // Below the block the floor looks at the block's backs, so that its row does not sum to 1.
  EXPECT_EQ(closed(joined(box(Vec3(0), Vec3(4)), box(Vec3(1, 1, 0), Vec3(2, 2, 1), true))), 0u);
}

TEST(ClosedFronts, APointIsEnclosedInsideAlone) {
  const std::vector<Vec3> points{{1, 1, 1}, {3, 1, 1}};
  const ClosedFronts found = closed_fronts(box(Vec3(0), Vec3(2)), points, 1e-6);
  EXPECT_TRUE(found.points[0]);
  EXPECT_FALSE(found.points[1]);
}

}  // namespace
}  // namespace enfilade
