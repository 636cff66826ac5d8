#include "report/survey/room_cameras.hpp"

#include <gtest/gtest.h>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

using test::LitRooms;

SurveyRoom room(const std::string& name, double x0, double x1, double y1) {
  SurveyRoom result;
  result.name = name;
  result.plan = RoomPlan(std::vector<Vec2>{{x0, 0}, {x1, 0}, {x1, y1}, {x0, y1}});
  result.area_m2 = result.plan.area_m2();
  result.ceiling_m = 3.0;
  result.has_floor = result.has_ceiling = true;
  return result;
}

TEST(RoomCameras, StandsAtEyeHeightAndLooksAlongTheRoom) {
  LitRooms rooms;
  rooms.set_irradiance([](const Vec3&) { return 10.0; });
  const std::optional<RoomView> view = standing_view(rooms.solved(), room("a", 0, 4, 5));
  ASSERT_TRUE(view);
  EXPECT_NEAR(view->camera.eye.z, 1.6, 1e-9);
  EXPECT_NEAR(view->light, 5.0, 0.5);  // reflectance 0.5
  // Of 4 m x 5 m the longest views run from corner to corner: 4 m and more lie ahead.
  const Vec3 d = glm::normalize(view->camera.look_at - view->camera.eye);
  const RayHit hit = rooms.occluders->rays().closest(view->camera.eye, Vec3(d.x, d.y, 0.0));
  EXPECT_GT(hit.distance_m, 4.0);
}

TEST(RoomCameras, LooksNoFurtherThanTheRoom) {
  // A room that is the near part of a larger space: its own length counts, not that of the space.
  LitRooms rooms;
  rooms.set_irradiance([](const Vec3&) { return 10.0; });
  const std::optional<RoomView> view = standing_view(rooms.solved(), room("part", 0, 4, 1.2));
  ASSERT_TRUE(view);
  EXPECT_LT(view->camera.eye.y, 1.2);
  const Vec3 d = view->camera.look_at - view->camera.eye;
  EXPECT_GT(std::abs(d.x), std::abs(d.y)) << "along its 4 m";
}

TEST(RoomCameras, ShowsLitRoomsLargestFirst) {
  LitRooms rooms(3);
  rooms.set_irradiance([](const Vec3& p) { return p.x > 8.3 ? 0.0 : 10.0; });
  std::vector<SurveyRoom> list{room("small", 0, 4, 3), room("large", 4.2, 8.2, 5),
                               room("dark", 8.4, 12.4, 5)};
  const std::vector<std::optional<RoomView>> views = standing_views(rooms.solved(), list);
  EXPECT_EQ(rooms_to_show(list, views), (std::vector<std::size_t>{1, 0}));
  list[1].has_ceiling = false;  // a roof
  EXPECT_EQ(rooms_to_show(list, views), (std::vector<std::size_t>{0}));
  list[1].has_ceiling = true;
  const std::vector<Camera> cameras = room_cameras(rooms.solved(), list, views);
  ASSERT_EQ(cameras.size(), 3u);
  EXPECT_EQ(cameras[0].name, "room-1");
  EXPECT_EQ(cameras[0].title, "large");
  EXPECT_EQ(cameras[2].name, "storey-1");
}

TEST(RoomCameras, DoesNotStandInAWallOrOutside) {
  LitRooms rooms;
  rooms.set_irradiance([](const Vec3&) { return 10.0; });
  EXPECT_FALSE(standing_view(rooms.solved(), room("wall", 4.02, 4.18, 5)));
}

}  // namespace
}  // namespace enfilade
