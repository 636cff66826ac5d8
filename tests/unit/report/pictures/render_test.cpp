#include "report/pictures/render.hpp"

#include <gtest/gtest.h>

#include "geometry/form_factor.hpp"
#include "report/pictures/camera_view.hpp"
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
  config.gather_rays = 0;
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

/// The lit floor straight from above, by each pixel's mean in 2 m x 2 m.
Camera from_above() {
  Camera camera;
  camera.eye = {2.0, 2.5, 2.0};
  camera.look_at = {2.0, 2.5, 0.0};
  camera.up = {0, 1, 0};
  camera.parallel_height_m = 2.0;
  return camera;
}

TEST(Render, GatheredLightIsThatOfTheLampAndTheWalls) {
  // Walls, floor and ceiling have radiosity 20 everywhere, the lamp 100: light at the floor is 20
  // and what the lamp gives more than the ceiling behind it, by closed form.
  LitRooms rooms;
  rooms.set_irradiance([](const Vec3&) { return 40.0; });
  RenderConfig config = small(40, 40);
  config.gather_rays = 1024;
  const LightImage image = render(rooms.solved(), from_above(), config);
  EXPECT_GT(image.gathered_places, 24u);
  const Polygon lamp{{1.5, 2, 2.9}, {1.5, 3, 2.9}, {2.5, 3, 2.9}, {2.5, 2, 2.9}};
  for (int y = 2; y < 40; y += 5) {
    for (int x = 2; x < 40; x += 5) {
      const Vec3 p(1.0 + 0.05 * (x + 0.5), 3.5 - 0.05 * (y + 0.5), 0.0);
      const double expected = 20.0 + 80.0 * point_to_polygon(p, Vec3(0, 0, 1), lamp);
      EXPECT_NEAR(pixel(image, x, y).irradiance, expected, 0.02 * expected);
      EXPECT_NEAR(pixel(image, x, y).radiosity[0], 0.5 * pixel(image, x, y).irradiance, 1e-3);
    }
  }
}

TEST(Render, GatheredLightShowsNoPatches) {
  // Light in steps from patch to patch: what is gathered has none of them.
  LitRooms rooms(1, 1, Basis::constant);
  rooms.subdivide(1.3);
  rooms.set_irradiance([](const Vec3& p) { return 10.0 * p.x; });
  const auto widest_step = [](const LightImage& image) {
    double widest = 0.0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 1; x < image.width; ++x)
        widest = std::max<double>(
            widest, std::abs(pixel(image, x, y).irradiance - pixel(image, x - 1, y).irradiance));
    }
    return widest;
  };
  RenderConfig config = small(40, 40);
  const double of_patches = widest_step(render(rooms.solved(), from_above(), config));
  config.gather_rays = 256;
  EXPECT_LT(widest_step(render(rooms.solved(), from_above(), config)), 0.1 * of_patches);
}

TEST(Render, GatheredLightKeepsToItsPlane) {
  // At the edge of floor and wall no light of one is mixed into the other, which has another angle
  // to the lamp.
  LitRooms rooms;
  rooms.set_irradiance([](const Vec3&) { return 0.0; });
  RenderConfig config = small(60, 60);
  config.gather_rays = 16;
  Camera camera = looking({2.0, 2.5, 1.5}, {4.0, 2.5, 0.0});
  camera.vertical_angle_deg = 30.0;
  const LightImage image = render(rooms.solved(), camera, config);
  const Polygon lamp{{1.5, 2, 2.9}, {1.5, 3, 2.9}, {2.5, 3, 2.9}, {2.5, 2, 2.9}};
  const SolvedScene solved = rooms.solved();
  const CameraView view(solved, camera, 1.0);
  int walls = 0;
  for (int y = 1; y < 60; y += 4) {
    for (int x = 1; x < 60; ++x) {
      const CameraView::Seen seen = view.at(2.0 * (x + 0.5) / 60 - 1.0, 1.0 - 2.0 * (y + 0.5) / 60);
      if (seen.what != CameraView::Seen::What::front) continue;
      const PolygonRef ref = rooms.occluders->local(seen.polygon);
      const Vec3 n = rooms.states[ref.cluster.index()].patches().frames()[ref.polygon].n;
      const double expected = 100.0 * point_to_polygon(seen.p, n, lamp);
      EXPECT_NEAR(pixel(image, x, y).irradiance, expected, 0.06 * expected + 0.02);
      walls += n.z < 0.5;
    }
  }
  EXPECT_GT(walls, 200);
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
