#include "report/pictures/false_colour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// Irradiance rises tenfold every 100 pixels from 1 on.
LightImage ramp() {
  LightImage image;
  image.width = 400;
  image.height = 200;
  image.pixels.resize(400 * 200);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 400; ++x) {
      auto& p = image.pixels[static_cast<std::size_t>(y * 400 + x)];
      p.cover = 1.0f;
      p.irradiance = static_cast<float>(std::pow(10.0, x / 100.0));
    }
  }
  return image;
}

TEST(FalseColour, ColourSaysTheLight) {
  FalseColourConfig config;
  config.lowest = 1.0;
  config.highest = 1e4;
  const Bitmap bitmap = false_coloured(ramp(), "lx", config);
  for (int x : {0, 100, 200, 300}) {
    const Rgb8 expected = scale_colour(x / 400.0), found = bitmap.at(x, 100);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1) << x;
  }
  config.logarithmic = false;
  EXPECT_EQ(false_coloured(ramp(), "lx", config).at(300, 100)[0],
            scale_colour((1000.0 - 1.0) / 9999.0)[0]);
}

TEST(FalseColour, FindsItsScale) {
  // 1 .. 10,000 in the picture: the ends of the scale lie within it, rounded outward to 1, 2, 5.
  const Bitmap bitmap = false_coloured(ramp(), "W/m2");
  EXPECT_EQ(bitmap.at(0, 100), scale_colour(0.0));
  const Rgb8 hundred = bitmap.at(200, 100), expected = scale_colour(0.5);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(hundred[c], expected[c], 1);
}

TEST(FalseColour, LegendShowsTheWholeScale) {
  const Bitmap bitmap = false_coloured(ramp(), "lx");
  int low = 0, high = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 320; x < 400; ++x) {
      low += bitmap.at(x, y) == scale_colour(0.0);
      high += bitmap.at(x, y) == scale_colour(1.0);
    }
  }
  EXPECT_GT(low, 5);
  EXPECT_GT(high, 5);
}

TEST(FalseColour, DarkPictureHasALegendToo) {
  LightImage image;
  image.width = 64;
  image.height = 64;
  image.pixels.resize(64 * 64);
  EXPECT_EQ(false_coloured(image, "lx").width, 64);
}

}  // namespace
}  // namespace enfilade
