#include "import/ifc/floor_outline.hpp"

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

void add_box(std::vector<Vec2>& corners, const Vec2& a, const Vec2& b) {
  for (const Vec2& p : {a, Vec2(b.x, a.y), b, a, b, Vec2(a.x, b.y)}) corners.push_back(p);
}

TEST(FloorOutline, OfTrianglesThatMeetBetweenCorners) {
  // An L: a long box and a short one beside half of it, rounded apart by 0.01 mm.
  std::vector<Vec2> corners;
  add_box(corners, {0, 0}, {4, 1});
  add_box(corners, {0, 1.00001}, {2, 3});
  const std::vector<Vec2> outline = floor_outline(corners);
  ASSERT_EQ(outline.size(), 6u);
  double twice = 0.0;
  for (std::size_t i = 0; i < 6; ++i) twice += cross2(outline[i], outline[(i + 1) % 6]);
  EXPECT_NEAR(0.5 * twice, 8.0, 1e-2);
}

TEST(FloorOutline, OfRectanglesHasFourCorners) {
  std::vector<Vec2> corners;
  add_box(corners, {1, 1}, {3, 2});
  EXPECT_EQ(floor_outline(corners).size(), 4u);
  add_box(corners, {3, 1}, {5, 2});
  EXPECT_EQ(floor_outline(corners).size(), 4u);
}

TEST(FloorOutline, WithoutAreaThereIsNone) {
  EXPECT_TRUE(floor_outline({}).empty());
  EXPECT_TRUE(floor_outline({{0, 0}, {1, 0}, {2, 0}}).empty());
}

}  // namespace
}  // namespace enfilade
