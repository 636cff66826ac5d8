#include "report/survey/room_plan.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

const std::vector<Vec2> l_shape{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 5}, {0, 5}};

TEST(RoomPlan, OfAnOutlineThatIsNotConvex) {
  const RoomPlan room(l_shape);
  EXPECT_NEAR(room.area_m2(), 18.0, 1e-12);
  EXPECT_TRUE(room.contains({1.0, 4.0}));
  EXPECT_FALSE(room.contains({3.0, 3.0}));
  EXPECT_NEAR(room.distance_to_edge({1.0, 1.0}), 1.0, 1e-5);
  EXPECT_NEAR(room.distance_to_edge({3.0, 3.0}), 1.0, 1e-5);
  const PlanRectangle box = room.rectangle();
  EXPECT_DOUBLE_EQ(box.length_m, 6.0);
  EXPECT_DOUBLE_EQ(box.width_m, 5.0);
}

TEST(RoomPlan, PartsThatMeetHaveNoEdgeBetweenThem) {
  // The second begins where the first ends, but for rounding.
  const double cut = 2.0 + 3e-10;
  const RoomPlan room(std::vector<Polygon>{{{0, 0, 1}, {2, 0, 1}, {2, 3, 1}, {0, 3, 1}},
                                           {{cut, 0, 1}, {5, 0, 1}, {5, 3, 1}, {cut, 3, 1}}});
  ASSERT_EQ(room.rings().size(), 1u);
  EXPECT_NEAR(room.distance_to_edge({2.0, 1.5}), 1.5, 1e-5);
}

TEST(RoomPlan, SpreadsPointsEvenly) {
  const RoomPlan room(l_shape);
  const std::vector<Vec2> points = room.spread(400);
  EXPECT_NEAR(static_cast<double>(points.size()), 400.0, 40.0);
  std::size_t in_leg = 0;
  for (const Vec2& p : points) {
    EXPECT_TRUE(room.contains(p));
    in_leg += p.y > 2.0;
  }
  EXPECT_NEAR(static_cast<double>(in_leg) / static_cast<double>(points.size()), 6.0 / 18.0, 0.03);
}

}  // namespace
}  // namespace enfilade
