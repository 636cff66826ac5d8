#include "scene/equal_bands.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

Scene scene_of(const std::vector<Spectrum>& reflectances, const Spectrum& intensity) {
  Scene scene;
  scene.bands = static_cast<int>(intensity.size());
  for (const Spectrum& reflectance : reflectances) {
    Surface surface;
    surface.reflectance = reflectance;
    surface.exitance = Spectrum(intensity.size(), 0.0);
    scene.surfaces.push_back(surface);
  }
  scene.lights.push_back({Vec3(0.0), intensity});
  return scene;
}

TEST(EqualBands, LeavesOneOfEachSet) {
  Scene scene = scene_of({{0.5, 0.2, 0.5, 0.2}, {0.1, 0.1, 0.1, 0.1}}, {7.0, 8.0, 7.0, 8.0});
  merge_equal_bands(scene);
  EXPECT_EQ(scene.bands, 2);
  EXPECT_EQ(scene.surfaces[0].reflectance, Spectrum({0.5, 0.2}));
  EXPECT_EQ(scene.surfaces[1].exitance.size(), 2u);
  EXPECT_EQ(scene.lights[0].intensity, Spectrum({7.0, 8.0}));
  EXPECT_EQ(bands_of_file(scene), 4u);
  EXPECT_EQ(in_bands_of_file(scene, Spectrum{1.0, 3.0}), Spectrum({1.0, 3.0, 1.0, 3.0}));
  merge_equal_bands(scene);
  EXPECT_EQ(bands_of_file(scene), 4u);
}

TEST(EqualBands, ALightOfItsOwnColourKeepsABandApart) {
  Scene scene = scene_of({{0.5, 0.5}}, {7.0, 8.0});
  merge_equal_bands(scene);
  EXPECT_EQ(scene.bands, 2);
  EXPECT_EQ(in_bands_of_file(scene, Spectrum{1.0, 3.0}), Spectrum({1.0, 3.0}));
}

TEST(EqualBands, AsTheyAreWhereNothingWasMerged) {
  const Scene scene = scene_of({{0.5, 0.5}}, {7.0, 7.0});
  EXPECT_EQ(bands_of_file(scene), 2u);
  EXPECT_EQ(in_bands_of_file(scene, Spectrum{1.0, 3.0}), Spectrum({1.0, 3.0}));
}

}  // namespace
}  // namespace enfilade
