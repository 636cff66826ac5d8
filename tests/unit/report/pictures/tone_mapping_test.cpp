#include "report/pictures/tone_mapping.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace enfilade {
namespace {

TEST(ToneMapping, ShowsTheMiddleAsTheKey) {
  // Even light: its log average is itself; equation 4 with white at 1 leaves 0.18 as it is.
  const ToneMap map({{250.0, 1.0}, {250.0, 3.0}}, {});
  EXPECT_NEAR(map({250.0, 250.0, 250.0})[1], 0.18, 1e-12);
}

TEST(ToneMapping, IsTheSameInAnyUnit) {
  std::vector<std::pair<double, double>> light, scaled;
  for (int i = 1; i < 50; ++i) {
    light.emplace_back(i * i, 1.0);
    scaled.emplace_back(179.0 * i * i, 1.0);
  }
  const ToneMap a(light, {}), b(scaled, {});
  EXPECT_NEAR(a({30, 20, 10})[0], b({179.0 * 30, 179.0 * 20, 179.0 * 10})[0], 1e-12);
}

TEST(ToneMapping, RisesAndStaysInRange) {
  const ToneMap map({{1.0, 100.0}, {1e5, 1.0}}, {});
  double before = -1.0;
  for (double l = 0.0; l < 1e6; l = 1.3 * l + 0.01) {
    const double shown = map({l, l, l})[0];
    EXPECT_GE(shown, before);
    EXPECT_LE(shown, 1.0);
    before = shown;
  }
  EXPECT_DOUBLE_EQ(before, 1.0);
}

TEST(ToneMapping, DarkCupboardsDoNotBrightenTheRoom) {
  const ToneMap clean({{100.0, 1.0}}, {}), with_dark({{100.0, 1.0}, {1e-9, 0.4}, {0.0, 0.4}}, {});
  EXPECT_DOUBLE_EQ(clean.exposure(), with_dark.exposure());
}

TEST(ToneMapping, AGivenExposureIsKept) {
  ToneConfig config;
  config.curve = ToneConfig::Curve::linear;
  config.exposure = 0.01;
  const ToneMap map({{5.0, 1.0}}, config);
  EXPECT_DOUBLE_EQ(map({20, 30, 40})[2], 0.4);
}

TEST(ToneMapping, NoLightIsBlack) {
  const ToneMap map({}, {});
  EXPECT_EQ(map({0, 0, 0})[0], 0.0);
}

TEST(ToneMapping, SrgbCurve) {
  EXPECT_EQ(srgb8(0.0), 0);
  EXPECT_EQ(srgb8(1.0), 255);
  EXPECT_EQ(srgb8(0.2140411), 127);  // IEC 61966-2-1: half grey
  EXPECT_EQ(srgb8(7.0), 255);
}

TEST(ToneMapping, EveryByteIsTheNearest) {
  for (int i = 0; i < 10000; ++i) {
    const double linear = std::pow(i / 1e4, 2.0);
    const double curve =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    EXPECT_NEAR(srgb8(linear), 255.0 * curve, 0.501) << linear;
  }
}

TEST(ToneMapping, ALargePicturesExposureIsThatOfAllColumns) {
  // Bright and dark columns in turn: pixels at an even distance would find one kind alone.
  LightImage small, large;
  for (auto& [image, edge] : {std::pair{&small, 4}, std::pair{&large, 1024}}) {
    image->width = image->height = edge;
    image->pixels.resize(static_cast<std::size_t>(edge * edge));
    for (std::size_t i = 0; i < image->pixels.size(); ++i) {
      const float light = i % 2 == 0 ? 100.0f : 10.0f;
      image->pixels[i] = {{light, light, light}, light, 1, 0, 0};
    }
  }
  const Bitmap few = tone_mapped(small), many = tone_mapped(large);
  for (const int x : {0, 1}) EXPECT_NEAR(many.at(x, 0)[0], few.at(x, 0)[0], 1);
}

TEST(ToneMapping, BackgroundIsWhereNothingWasMet) {
  LightImage image;
  image.width = 2;
  image.height = 1;
  image.pixels.resize(2);
  image.pixels[0].cover = 1.0f;  // met a black surface
  const Bitmap bitmap = tone_mapped(image);
  EXPECT_EQ(bitmap.at(0, 0), (Rgb8{0, 0, 0}));
  EXPECT_GT(bitmap.at(1, 0)[0], 200);
}

}  // namespace
}  // namespace enfilade
