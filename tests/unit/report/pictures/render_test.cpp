#include "report/pictures/render.hpp"

#include <gtest/gtest.h>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

using test::LitRooms;

RenderConfig small(int width = 32, int height = 18) {
  RenderConfig config;
  config.width = width;
  config.height = height;
  config.samples = 1;
  config.threads = 1;
  return config;
}

Camera looking(const Vec3& eye, const Vec3& at) {
  Camera camera;
  camera.eye = eye;
  camera.look_at = at;
  return camera;
}

const LightImage::Pixel& pixel(const LightImage& image, int x, int y) {
  return image.pixels[static_cast<std::size_t>(y * image.width + x)];
}

TEST(Render, ShowsTheLightAtEachPoint) {
  LitRooms rooms;
  rooms.subdivide(0.5);
  rooms.set_irradiance([](const Vec3& p) { return 10.0 + 3.0 * p.x + 2.0 * p.y; });
  // Straight down, in parallel: a pixel of 0.1 m shows its own place on the floor.
  Camera camera = looking({1.0, 1.0, 2.0}, {1.0, 1.0, 0.0});
  camera.up = {0, 1, 0};
  camera.parallel_height_m = 1.8;
  const LightImage image = render(rooms.solved(), camera, small(18, 18));
  for (int y = 0; y < 18; ++y) {
    for (int x = 0; x < 18; ++x) {
      const Vec3 p(0.1 + 0.1 * (x + 0.5), 1.9 - 0.1 * (y + 0.5), 0.0);
      const double expected = 10.0 + 3.0 * p.x + 2.0 * p.y;
      EXPECT_NEAR(pixel(image, x, y).irradiance, expected, 0.26);  // half a pixel aside at most
      EXPECT_NEAR(pixel(image, x, y).radiosity[0], 0.5 * pixel(image, x, y).irradiance, 1e-4);
      EXPECT_EQ(pixel(image, x, y).cover, 1.0f);
    }
  }
}

TEST(Render, PerspectiveHasItsAngle) {
  LitRooms rooms;
  // The lamp's near edge, 0.9 m high above the eye's level 2 m away, at 24.2 degrees.
  Camera camera = looking({2.0, 0.0 + 1e-3, 2.0}, {2.0, 5.0, 2.0});
  camera.vertical_angle_deg = 2.0 * 24.3;
  const RenderConfig config = small(1, 1000);
  const LightImage image = render(rooms.solved(), camera, config);
  // The lamp spans heights 0.9/3 .. 0.9/2 (tangents); the picture spans +- tan 24.3.
  const double half = std::tan(glm::radians(24.3));
  int lit = 0;
  for (int y = 0; y < 1000; ++y) lit += pixel(image, 0, y).radiosity[0] > 99.0f;
  EXPECT_NEAR(lit, 1000 * (0.9 / 2 - 0.9 / 3) / (2 * half), 3);
}

TEST(Render, IsTheSameWithAnyNumberOfThreads) {
  LitRooms rooms(2, 3);
  rooms.set_irradiance([](const Vec3& p) { return p.x + p.z; });
  RenderConfig config = small();
  config.samples = 4;
  const Camera camera = looking({0.5, 0.5, 1.6}, {3.0, 4.0, 1.0});
  const LightImage one = render(rooms.solved(), camera, config);
  config.threads = 3;
  const LightImage three = render(rooms.solved(), camera, config);
  for (std::size_t i = 0; i < one.pixels.size(); ++i) {
    EXPECT_EQ(one.pixels[i].irradiance, three.pixels[i].irradiance);
    EXPECT_EQ(one.pixels[i].radiosity[2], three.pixels[i].radiosity[2]);
  }
}

TEST(Render, BacksAreBlackButThere) {
  LitRooms rooms;
  rooms.set_irradiance([](const Vec3&) { return 50.0; });
  // Between ceiling and lamp, looking down on the lamp's back.
  const LightImage image =
      render(rooms.solved(), looking({2, 2.5, 2.99}, {2, 2.6, 2.9}), small(4, 4));
  EXPECT_EQ(pixel(image, 1, 1).cover, 1.0f);
  EXPECT_EQ(pixel(image, 1, 1).radiosity[0], 0.0f);
}

TEST(Render, CutAwayLooksIntoTheRooms) {
  LitRooms rooms(2);
  rooms.set_irradiance([](const Vec3& p) { return p.z < 0.01 ? 70.0 : 30.0; });
  Camera camera = looking({4.1, -10.0, 20.0}, {4.1, 2.5, 1.0});
  camera.parallel_height_m = 9.0;
  const LightImage closed = render(rooms.solved(), camera, small(64, 64));
  camera.cut_above_m = 1.5;
  const LightImage cut = render(rooms.solved(), camera, small(64, 64));
  int floor = 0, wall = 0, solid = 0;
  for (std::size_t i = 0; i < cut.pixels.size(); ++i) {
    EXPECT_EQ(closed.pixels[i].irradiance, 0.0f) << "the closed building shows its unlit shell";
    floor += cut.pixels[i].irradiance == 70.0f;
    wall += cut.pixels[i].irradiance == 30.0f;
    solid += cut.pixels[i].section > 0.0f;
  }
  EXPECT_GT(floor, 64 * 64 / 6);
  EXPECT_GT(wall, 64 * 64 / 40);
  EXPECT_GT(solid, 64 * 64 / 100);
}

TEST(Render, GatherAgreesWithEvenLight) {
  // The light of patches that are small for their distance is taken as it is.
  LitRooms rooms;
  rooms.subdivide(0.05);
  rooms.set_irradiance([](const Vec3&) { return 40.0; });
  RenderConfig config = small(4, 4);
  config.gather_rays = 256;
  const LightImage image = render(rooms.solved(), looking({2, 1, 1}, {2, 1.2, 0}), config);
  // Walls have radiosity 20; the lamp, 1 m2 of 100, adds some below it.
  EXPECT_GT(pixel(image, 2, 2).irradiance, 20.0f);
  EXPECT_LT(pixel(image, 2, 2).irradiance, 30.0f);
  EXPECT_NEAR(pixel(image, 2, 2).radiosity[0], 0.5f * pixel(image, 2, 2).irradiance, 1e-3);
}

TEST(Render, SmoothLightKeepsSlopesAndMeans) {
  LitRooms rooms(1, 1, Basis::constant);
  rooms.subdivide(1.3);
  rooms.set_irradiance([](const Vec3& p) { return 10.0 * p.x; });
  Camera camera = looking({2.0, 2.5, 2.0}, {2.0, 2.5, 0.0});
  camera.up = {0, 1, 0};
  camera.parallel_height_m = 2.0;
  RenderConfig config = small(40, 40);
  config.samples = 16;
  const LightImage smooth = render(rooms.solved(), camera, config);
  config.smooth = false;
  const LightImage plain = render(rooms.solved(), camera, config);
  double widest_plain = 0.0, widest_smooth = 0.0, sum_plain = 0.0, sum_smooth = 0.0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      sum_plain += pixel(plain, x, y).radiosity[0];
      sum_smooth += pixel(smooth, x, y).radiosity[0];
      EXPECT_EQ(pixel(smooth, x, y).irradiance, pixel(plain, x, y).irradiance);
      if (x == 0) continue;
      const auto step = [&](const LightImage& image) {
        return std::abs(pixel(image, x, y).radiosity[0] - pixel(image, x - 1, y).radiosity[0]);
      };
      widest_plain = std::max<double>(widest_plain, step(plain));
      widest_smooth = std::max<double>(widest_smooth, step(smooth));
    }
  }
  EXPECT_LT(widest_smooth, 0.5 * widest_plain) << "steps between patches become slopes";
  EXPECT_NEAR(sum_smooth, sum_plain, 0.01 * sum_plain);
}

TEST(Render, BandsBecomeColours) {
  EXPECT_EQ(display_rgb(std::vector<double>{4.0}), (std::array<double, 3>{4, 4, 4}));
  EXPECT_EQ(display_rgb(std::vector<double>{1, 2, 3}), (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(display_rgb(std::vector<double>{1, 3, 4, 6, 10, 20}),
            (std::array<double, 3>{2, 5, 15}));
}

}  // namespace
}  // namespace enfilade
