#include "report/pictures/first_surfaces.hpp"

#include <gtest/gtest.h>

#include "report/pictures/render.hpp"
#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

constexpr int pixels_wide = 40;

bool never(std::uint32_t, std::uint32_t) { return false; }

/// The lamp, 1 m x 1 m before the unlit ceiling, straight from below in 2 m x 2 m.
Camera from_below() {
  Camera camera;
  camera.eye = {2.0, 2.5, 1.0};
  camera.look_at = {2.0, 2.5, 3.0};
  camera.up = {0, 1, 0};
  camera.parallel_height_m = 2.0;
  return camera;
}

TEST(FirstSurfaces, AreEvenAwayFromEdges) {
  const test::LitRooms rooms;
  const SolvedScene solved = rooms.solved();
  const Camera camera = from_below();
  const FirstSurfaces surfaces(CameraView(solved, camera, 1.0), pixels_wide, pixels_wide, 1, 1);
  const auto on_edge = [](int x) { return x == 9 || x == 10 || x == 29 || x == 30; };
  const auto beyond = [](int x) { return x < 9 || x > 30; };
  for (int y = 0; y < pixels_wide; ++y) {
    for (int x = 0; x < pixels_wide; ++x) {
      const bool near = (on_edge(x) && !beyond(y)) || (on_edge(y) && !beyond(x));
      EXPECT_EQ(surfaces.even(x, y, never), !near) << x << ", " << y;
    }
  }
}

TEST(FirstSurfaces, OnePixelOfAnotherPolygonIsSeenFromAllAround) {
  test::LitRooms rooms;
  const SolvedScene solved = rooms.solved();
  Camera camera = from_below();
  camera.parallel_height_m = 40.0;  // the lamp is one pixel wide, or hits two
  const FirstSurfaces surfaces(CameraView(solved, camera, 1.0), pixels_wide, pixels_wide, 1, 1);
  int uneven = 0;
  for (int y = 0; y < pixels_wide; ++y) {
    for (int x = 0; x < pixels_wide; ++x) uneven += !surfaces.even(x, y, never);
  }
  EXPECT_GE(uneven, 9);
}

TEST(FirstSurfaces, TakesPolygonsThatLookAlikeForOne) {
  const test::LitRooms rooms;
  const SolvedScene solved = rooms.solved();
  const Camera camera = from_below();
  const FirstSurfaces surfaces(CameraView(solved, camera, 1.0), pixels_wide, pixels_wide, 1, 1);
  const std::uint32_t ceiling = surfaces.at(0, 0).polygon, lamp = surfaces.at(20, 20).polygon;
  ASSERT_NE(ceiling, lamp);
  const auto always = [&](std::uint32_t a, std::uint32_t b) {
    EXPECT_TRUE((a == ceiling && b == lamp) || (a == lamp && b == ceiling));
    return true;
  };
  EXPECT_TRUE(surfaces.even(10, 20, always));
  EXPECT_FALSE(surfaces.even(10, 20, never));
}

TEST(FirstSurfaces, EdgesAreSmoothInThePicture) {
  // A lamp turned against the pixels: along its edges pixels show it in part, in all quarters.
  const test::LitRooms rooms;
  Camera camera = from_below();
  camera.up = {0.3, 1, 0};
  RenderConfig config;
  config.width = config.height = 200;
  config.samples = 4;
  const LightImage image = render(rooms.solved(), camera, config);
  std::array<int, 5> with{};
  for (const LightImage::Pixel& pixel : image.pixels) {
    ASSERT_EQ(pixel.cover, 1.0f);
    ++with[static_cast<std::size_t>(std::lround(pixel.radiosity[0] / 25.0))];
  }
  // The lamp is a quarter of the picture; its edges pass 400 pixels and more.
  EXPECT_NEAR(with[4], 10000, 600);
  for (const std::size_t quarters : {1, 2, 3}) EXPECT_GT(with[quarters], 60) << quarters;
  const double mean = with[4] + 0.75 * with[3] + 0.5 * with[2] + 0.25 * with[1];
  EXPECT_NEAR(mean, 10000, 100);
}

}  // namespace
}  // namespace enfilade
