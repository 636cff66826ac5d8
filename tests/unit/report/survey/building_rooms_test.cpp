#include "report/survey/building_rooms.hpp"

#include <gtest/gtest.h>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

BuildingRoom told(const std::string& name, Vec3 lo, Vec3 hi, double floor_area_m2 = 0.0) {
  BuildingRoom room;
  room.name = name;
  room.box.add(lo);
  room.box.add(hi);
  room.floor_area_m2 = floor_area_m2;
  return room;
}

TEST(BuildingRooms, AreTheCellsWhereNoneIsTold) {
  const test::LitRooms rooms(2);
  const std::vector<SurveyRoom> found = rooms_of_building(rooms.solved().building(), {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "cell 0");
  EXPECT_EQ(found[0].storey, "Storey 1");
  EXPECT_NEAR(found[0].floor_m, 0.0, 1e-6);
  EXPECT_NEAR(found[0].ceiling_m, 3.0, 1e-6);
  EXPECT_NEAR(found[0].area_m2, 20.0, 1e-6);
}

TEST(BuildingRooms, HaveTheirNamesAndStoreysOfTheFile) {
  const test::LitRooms rooms(2);
  std::vector<BuildingRoom> list{told("1.01", {0, 0, 0}, {4, 5, 3}),
                                 told("1.02", {4.2, 0, 0}, {8.2, 5, 3}, 19.5)};
  list[1].storey = "EG";
  list[1].required_lx = 500.0;
  const std::vector<SurveyRoom> found = rooms_of_building(rooms.solved().building(), list);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].storey, "Storey 1");
  EXPECT_EQ(found[1].storey, "EG");
  EXPECT_DOUBLE_EQ(found[1].area_m2, 19.5);  // as told
  EXPECT_NEAR(found[1].plan.area_m2(), 20.0, 1e-6);
  EXPECT_DOUBLE_EQ(found[1].required, 500.0);
}

TEST(BuildingRooms, ABoxThatReachesIntoAnotherRoomsCellEndsAtTheWall) {
  const test::LitRooms rooms(2);
  // As of an L-shaped room around the corner of its neighbour.
  const std::vector<BuildingRoom> list{told("l", {0, 0, 0}, {6, 5, 3}, 20.0),
                                       told("neighbour", {4.2, 0, 0}, {8.2, 5, 3})};
  const std::vector<SurveyRoom> found = rooms_of_building(rooms.solved().building(), list);
  // To the cut between the cells, half way through the wall.
  EXPECT_NEAR(found[0].plan.area_m2(), 4.1 * 5.0, 1e-6);
  EXPECT_FALSE(found[0].plan.contains({5.0, 2.0}));
  EXPECT_TRUE(found[1].plan.contains({5.0, 2.0}));
}

TEST(BuildingRooms, RoomsThatNoWallPartsShareTheirCell) {
  const test::LitRooms rooms(1);
  const std::vector<BuildingRoom> list{told("living", {0, 0, 0}, {4, 5, 3}, 14.0),
                                       told("kitchen", {0, 3, 0}, {3, 5, 3}, 6.0)};
  const std::vector<SurveyRoom> found = rooms_of_building(rooms.solved().building(), list);
  EXPECT_NEAR(found[0].plan.area_m2(), 14.0, 1e-6);
  EXPECT_NEAR(found[1].plan.area_m2(), 6.0, 1e-6);
  EXPECT_FALSE(found[0].plan.contains({1.0, 4.0}));
  EXPECT_TRUE(found[1].plan.contains({1.0, 4.0}));
}

TEST(BuildingRooms, AnOutlineIsTakenAsItIs) {
  const test::LitRooms rooms(1);
  BuildingRoom room = told("l", {0, 0, 0}, {4, 5, 3});
  room.outline = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 5}, {0, 5}};
  const std::vector<SurveyRoom> found = rooms_of_building(rooms.solved().building(), {&room, 1});
  EXPECT_NEAR(found[0].area_m2, 14.0, 1e-9);
}

}  // namespace
}  // namespace enfilade
