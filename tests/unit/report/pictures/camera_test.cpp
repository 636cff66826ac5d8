#include "report/pictures/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/error.hpp"
#include "report/pictures/render.hpp"
#include "report/plans/storeys.hpp"
#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

using test::LitRooms;

LitRooms lit(int rooms) {
  LitRooms lit_rooms(rooms);
  lit_rooms.subdivide(1.0);
  lit_rooms.set_irradiance([](const Vec3&) { return 100.0; });
  return lit_rooms;
}

TEST(Camera, StandsInEveryRoomAtEyeHeight) {
  const LitRooms rooms = lit(2);
  const auto cameras = automatic_cameras(rooms.solved());
  ASSERT_EQ(cameras.size(), 3u);
  std::vector<double> xs;
  for (int i : {0, 1}) {
    const Camera& c = cameras[static_cast<std::size_t>(i)];
    EXPECT_NEAR(c.eye.z, 1.6, 1e-9);
    EXPECT_GT(c.eye.y, 0.0);
    EXPECT_LT(c.eye.y, 5.0);
    xs.push_back(c.eye.x);
    // The longest view of a room of 4 m by 5 m runs along its length or its diagonal.
    const Vec3 d = glm::normalize(c.look_at - c.eye);
    EXPECT_GT(std::abs(d.y), 0.6);
  }
  std::sort(xs.begin(), xs.end());
  EXPECT_TRUE(xs[0] > 0.0 && xs[0] < 4.0 && xs[1] > 4.2 && xs[1] < 8.2);
}

TEST(Camera, CutAwayHoldsTheWholeStorey) {
  const LitRooms rooms = lit(2);
  const Camera camera = automatic_cameras(rooms.solved()).back();
  EXPECT_EQ(camera.name, "storey-1");
  ASSERT_TRUE(camera.cut_above_m.has_value());
  EXPECT_GT(*camera.cut_above_m, 1.5);
  EXPECT_LT(*camera.cut_above_m, 2.9);
  RenderConfig config;
  config.width = 96;
  config.height = 54;
  const LightImage image = render(rooms.solved(), camera, config);
  int covered = 0;
  for (int x = 0; x < 96; ++x) {
    for (int y = 0; y < 54; ++y) {
      const bool met = image.pixels[static_cast<std::size_t>(y * 96 + x)].cover > 0.0f;
      covered += met;
      const bool at_edge = x == 0 || y == 0 || x == 95 || y == 53;
      EXPECT_FALSE(at_edge && met) << "nothing is cut off at " << x << ", " << y;
    }
  }
  EXPECT_GT(covered, 96 * 54 / 4);
}

TEST(Camera, FindsNoPlaceInTheDark) {
  LitRooms rooms;
  const auto cameras = automatic_cameras(rooms.solved());
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras[0].name, "storey-1");
}

TEST(Camera, StoreysAreFloorsWithHeadroom) {
  const LitRooms rooms = lit(1);
  const auto levels = storeys(rooms.solved().building());
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_NEAR(levels[0].floor_m, 0.0, 1e-9);
  EXPECT_NEAR(levels[0].headroom_m, 3.0, 0.11);
}

std::string file_with(const std::string& text) {
  const std::string path = testing::TempDir() + "cameras.json";
  std::ofstream(path) << text;
  return path;
}

TEST(Camera, ReadsAFileOfCameras) {
  const auto cameras = read_cameras(file_with(
      R"({"cameras": [{"name": "hall", "eye": [1, 2, 3], "look_at": [4, 5, 6], "vertical_angle_deg": 45},
          {"eye": [0, 0, 9], "look_at": [0, 0, 0], "up": [0, 1, 0], "parallel_height_m": 5, "cut_above_m": -1}]})"));
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].name, "hall");
  EXPECT_EQ(cameras[0].look_at, Vec3(4, 5, 6));
  EXPECT_EQ(cameras[0].vertical_angle_deg, 45.0);
  EXPECT_FALSE(cameras[0].cut_above_m.has_value());
  EXPECT_EQ(cameras[1].name, "camera-2");
  EXPECT_EQ(cameras[1].parallel_height_m, 5.0);
  EXPECT_EQ(cameras[1].cut_above_m, -1.0);
}

TEST(Camera, NamesWhatIsWrongInTheFile) {
  for (const char* text :
       {R"({"cameras": [{"eye": [1, 2, 3]}]})",
        R"({"cameras": [{"eye": [1, 2], "look_at": [0, 0, 0]}]})",
        R"({"cameras": [{"eye": [1, 2, 3], "look_at": [1, 2, 3]}]})", R"({"cameras": []})", "[]",
        "{",
        R"({"cameras": [{"eye": [1, 2, 3], "look_at": [0, 0, 0], "vertical_angle_deg": -4}]})"}) {
    EXPECT_THROW(read_cameras(file_with(text)), InputError) << text;
  }
}

}  // namespace
}  // namespace enfilade
