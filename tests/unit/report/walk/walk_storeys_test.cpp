#include "report/walk/walk_storeys.hpp"

#include <gtest/gtest.h>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

SurveyRoom room(const std::string& storey, double area_m2, double floor_m) {
  SurveyRoom result;
  result.storey = storey;
  result.area_m2 = area_m2;
  result.floor_m = floor_m;
  result.ceiling_m = floor_m + 2.8;
  return result;
}

TEST(WalkStoreys, AreThoseOfTheRoomsLowestFirst) {
  const test::LitRooms rooms;
  const std::vector<SurveyRoom> list{room("Upper", 20, 3.0), room("Ground", 20, 0.0),
                                     room("Ground", 3, -0.4), room("Cellar", 10, -3.0)};
  const WalkStoreys storeys(rooms.solved(), list);
  ASSERT_EQ(storeys.all().size(), 3u);
  EXPECT_EQ(storeys.all()[0].name, "Cellar");
  EXPECT_EQ(storeys.all()[1].name, "Ground");
  EXPECT_DOUBLE_EQ(storeys.all()[1].floor_m, 0.0) << "that of most of its area";
  EXPECT_NEAR(storeys.all()[1].cut_m, 2.1, 1e-9);
  EXPECT_EQ(storeys.of(list[0]), 2u);
  EXPECT_EQ(storeys.of(list[2]), 1u);
}

TEST(WalkStoreys, ASurfaceBelongsToTheRoomThatItFaces) {
  test::LitRooms rooms;  // one room from 0 to 3 m
  const std::vector<SurveyRoom> list{room("Upper", 20, 3.0), room("Ground", 20, 0.0)};
  const WalkStoreys storeys(rooms.solved(), list);
  for (std::uint32_t k = 0; k < 6; ++k)
    EXPECT_EQ(storeys.of(rooms.clusters[0], k), 0u) << "floor, ceiling and walls of the room";
  // The shell lies in no cell: its top, 3.2 m high and looking up, is the upper storey's.
  bool top = false;
  for (std::uint32_t k = 0; k < 6; ++k) {
    const Polygon& face = rooms.clusters[2].polygons[k].polygon;
    if (normal(face).z < 0.5) continue;
    EXPECT_EQ(storeys.of(rooms.clusters[2], k), 1u);
    top = true;
  }
  EXPECT_TRUE(top);
}

TEST(WalkStoreys, WithoutRoomsAreFoundFromTheFloors) {
  const test::LitRooms rooms;
  const WalkStoreys storeys(rooms.solved(), {});
  ASSERT_EQ(storeys.all().size(), 1u);
  EXPECT_EQ(storeys.all()[0].name, "Storey 1");
}

}  // namespace
}  // namespace enfilade
