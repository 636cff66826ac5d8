#include "report/walk/light_channels.hpp"

#include <gtest/gtest.h>

#include "report/pictures/one_value.hpp"

namespace enfilade {
namespace {

Scene bands(int count, ExitanceUnit unit = ExitanceUnit::lumen_per_m2) {
  Scene scene;
  scene.bands = count;
  scene.unit = unit;
  return scene;
}

TEST(LightChannels, OfOneBandIsOne) {
  const Scene scene = bands(1);
  const LightChannels channels(scene);
  EXPECT_EQ(channels.count(), 1u);
  EXPECT_NEAR(channels.weights()[0], 1.0, 1e-12);
}

TEST(LightChannels, ThreeBandsThatAreSolvedAsOneAreOne) {
  Scene scene = bands(1);
  scene.band_of = {0, 0, 0};
  const LightChannels channels(scene);
  EXPECT_EQ(channels.count(), 1u);
  std::vector<double> out(1);
  channels.of(std::vector<double>{5.0}, out);
  EXPECT_DOUBLE_EQ(out[0], 5.0);
  EXPECT_NEAR(channels.weights()[0], 1.0, 1e-9);
}

TEST(LightChannels, RedGreenAndBlueWeighAsTheirLuminance) {
  const Scene scene = bands(3);
  const LightChannels channels(scene);
  ASSERT_EQ(channels.count(), 3u);
  EXPECT_NEAR(channels.weights()[0], 0.2126, 1e-9);
  EXPECT_NEAR(channels.weights()[1], 0.7152, 1e-9);
  EXPECT_NEAR(channels.weights()[2], 0.0722, 1e-9);
}

TEST(LightChannels, WeighToTheOneValueOfAnyNumberOfBands) {
  for (const ExitanceUnit unit : {ExitanceUnit::lumen_per_m2, ExitanceUnit::watt_per_m2}) {
    for (int count = 1; count <= 11; ++count) {
      const Scene scene = bands(count, unit);
      const LightChannels channels(scene);
      Spectrum light;
      for (int b = 0; b < count; ++b) light.push_back(1.0 + b * b);
      std::vector<double> shown(channels.count());
      channels.of(light, shown);
      double sum = 0.0;
      for (std::size_t c = 0; c < shown.size(); ++c) sum += channels.weights()[c] * shown[c];
      EXPECT_NEAR(sum, one_value(scene, light), 1e-9 * sum) << count << " bands";
    }
  }
}

}  // namespace
}  // namespace enfilade
