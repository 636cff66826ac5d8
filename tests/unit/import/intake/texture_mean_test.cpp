#include "import/intake/texture_mean.hpp"

#include <cmath>

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

// A plain PPM: two pixels, one of 50 % in sRGB's scale and one black.
TEST(TextureMean, IsTakenInLinearLight) {
  const std::string image = std::string("P6 2 1 255\n") + "\x80\xFF\x01" + std::string(3, '\0');
  const std::optional<TextureMean> mean = texture_mean(image);
  ASSERT_TRUE(mean.has_value());
  EXPECT_NEAR(mean->srgb[0], 0.5 * std::pow((128.0 / 255.0 + 0.055) / 1.055, 2.4), 1e-12);
  EXPECT_NEAR(mean->srgb[1], 0.5, 1e-12);
  EXPECT_NEAR(mean->srgb[2], 0.5 / 255.0 / 12.92, 1e-12);
  EXPECT_NEAR(mean->linear[0], 64.0 / 255.0, 1e-12);
  EXPECT_NEAR(mean->linear[3], 1.0, 1e-12);
}

TEST(TextureMean, RubbishHasNone) {
  EXPECT_FALSE(texture_mean("").has_value());
  EXPECT_FALSE(texture_mean("no image at all").has_value());
}

}  // namespace
}  // namespace enfilade
