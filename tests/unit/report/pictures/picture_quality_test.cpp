#include "report/pictures/picture_quality.hpp"

#include <gtest/gtest.h>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

TEST(PictureQuality, IsTheDefaultUpToTheDefaultError) {
  for (const double error : {0.0, 1e-9, 0.01, 0.02}) {
    const RenderConfig config = picture_quality(error), fine;
    EXPECT_EQ(config.width, fine.width);
    EXPECT_EQ(config.gather_rays, fine.gather_rays);
    EXPECT_EQ(config.gather_every_px, fine.gather_every_px);
    EXPECT_EQ(config.direct_every_px, fine.direct_every_px);
  }
}

TEST(PictureQuality, FallsWithTheErrorToItsLeast) {
  RenderConfig last;
  for (const double error : {0.03, 0.05, 0.1}) {
    const RenderConfig config = picture_quality(error);
    EXPECT_LT(config.width, last.width);
    EXPECT_LT(config.gather_rays, last.gather_rays);
    EXPECT_GT(config.gather_every_px, last.gather_every_px);
    last = config;
  }
  const RenderConfig least = picture_quality(1.0);
  EXPECT_EQ(least.width, last.width);
  EXPECT_EQ(least.height, 360);
  EXPECT_EQ(least.gather_rays, last.gather_rays);
}

TEST(PictureQuality, ARoughPictureIsNoWorseThanItsSolution) {
  test::LitRooms rooms;
  rooms.set_irradiance([](const Vec3& p) { return 20.0 + 10.0 * p.x; });
  Camera camera;
  camera.eye = {0.5, 0.5, 1.6};
  camera.look_at = {3.0, 4.0, 1.0};
  const LightImage fine = render(rooms.solved(), camera, picture_quality(0.02)),
                   rough = render(rooms.solved(), camera, picture_quality(0.1));
  double difference = 0.0, total = 0.0;
  for (int y = 0; y < rough.height; ++y) {
    for (int x = 0; x < rough.width; ++x) {
      const auto in_fine = [&](int i) { return (2 * i + 1) * fine.width / (2 * rough.width); };
      const double a =
          fine.pixels[static_cast<std::size_t>(in_fine(y) * fine.width + in_fine(x))].irradiance;
      const double b = rough.pixels[static_cast<std::size_t>(y * rough.width + x)].irradiance;
      difference += std::abs(a - b);
      total += a;
    }
  }
  EXPECT_LT(difference, 0.03 * total);
}

}  // namespace
}  // namespace enfilade
