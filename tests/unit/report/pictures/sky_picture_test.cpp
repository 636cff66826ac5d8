// What a picture shows where its rays leave the building.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "occluders/light_at.hpp"
#include "report/pictures/render.hpp"
#include "report/pictures/tone_mapping.hpp"
#include "scene/pane_law.hpp"
#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

using std::numbers::pi;

constexpr int width = 24, height = 12;
constexpr double zenith = 3000.0, ground_reflectance = 0.25;

/// A terrace of 2 m x 2 m under an overcast sky, and a pane at y = 1.5 m that stands before the
/// left half of what an eye at (0, 0, 1) sees towards y.
struct Terrace {
  Scene scene;
  std::vector<Cluster> clusters;
  std::vector<ClusterState> states;
  CellComplex cells;
  Occluders occluders;

  Terrace() : scene(made()), clusters(made_clusters(scene)), occluders(clusters) {
    for (const Cluster& c : clusters) states.emplace_back(c, scene, Basis::constant);
  }
  static Scene made() {
    Scene scene;
    scene.unit = ExitanceUnit::lumen_per_m2;
    Surface floor, pane;
    floor.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    floor.reflectance = floor.exitance = {0.0};
    pane.vertices = {{-9, 1.5, -9}, {0, 1.5, -9}, {0, 1.5, 9}, {-9, 1.5, 9}};
    pane.reflectance = pane.exitance = {0.0};
    pane.transmittance = {0.6};
    scene.surfaces = {floor, pane};
    scene.sky = Sky{};
    scene.sky->shape.overcast = true;
    scene.sky->zenith_luminance = {zenith};
    scene.sky->ground_reflectance = {ground_reflectance};
    make_sky_lights(scene);
    return scene;
  }
  static std::vector<Cluster> made_clusters(const Scene& scene) {
    std::vector<Cluster> clusters = testing::clusters_of(scene);
    set_panes(clusters, scene);
    return clusters;
  }
  LightImage picture(const Camera& camera) const {
    RenderConfig config;
    config.width = width;
    config.height = height;
    config.samples = 64;
    config.gather_rays = 0;
    return render({scene, cells, clusters, states, occluders}, camera, config);
  }
};

Camera level() {
  Camera camera;
  camera.eye = {0, 0, 1};
  camera.look_at = {0, 1, 1};
  camera.vertical_angle_deg = 40.0;
  return camera;
}

/// Direction of a place in the level camera's picture, in pixels.
Vec3 direction(double x, double y) {
  const double half = std::tan(20.0 * pi / 180.0);
  return glm::normalize(
      Vec3(2.0 * half * (2.0 * x / width - 1.0), 1.0, half * (1.0 - 2.0 * y / height)));
}

/// Of the sky by Moon and Spencer, else of a ground of diffuse reflection below all of it.
double expected_luminance(const Vec3& d) {
  if (d.z > 0.0) return zenith * (1.0 + 2.0 * d.z) / 3.0;
  return ground_reflectance * (7.0 / 9.0) * zenith;
}

TEST(SkyPicture, ShowsTheLuminanceOfSkyAndGround) {
  const LightImage image = Terrace().picture(level());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const LightImage::Pixel& pixel = image.pixels[static_cast<std::size_t>(y * width + x)];
      if (pixel.cover > 0.0f) continue;  // the floor
      // Luminance is monotone across a pixel: it lies between those of its corners.
      double least = 1e30, most = 0.0;
      for (const double dx : {0.001, 0.999}) {
        for (const double dy : {0.001, 0.999}) {
          const Vec3 d = direction(x + dx, y + dy);
          const double passed = x < width / 2 ? 0.6 * pane_share(d.y) : 1.0;
          least = std::min(least, passed * expected_luminance(d));
          most = std::max(most, passed * expected_luminance(d));
        }
      }
      EXPECT_EQ(pixel.sky, 1.0f);
      EXPECT_LT(most, 1.2 * least);
      EXPECT_GT(pixel.radiosity[0], 0.9999 * pi * least) << x << ", " << y;
      EXPECT_LT(pixel.radiosity[0], 1.0001 * pi * most) << x << ", " << y;
      EXPECT_EQ(pixel.irradiance, 0.0f);
    }
  }
}

TEST(SkyPicture, TheFloorHasTheSkysLight) {
  const Terrace terrace;
  Camera camera;
  camera.eye = {0, 0, 2};
  camera.look_at = {0, 0, 0};
  camera.up = {0, 1, 0};
  camera.parallel_height_m = 1.5;
  RenderConfig config;
  config.width = config.height = 48;
  config.samples = 1;
  const LightImage image =
      render({terrace.scene, terrace.cells, terrace.clusters, terrace.states, terrace.occluders},
             camera, config);
  for (const int x : {6, 20, 33, 46}) {
    for (const int y : {5, 24, 40}) {
      const Vec3 p(1.5 * ((x + 0.5) / 48 - 0.5), 1.5 * (0.5 - (y + 0.5) / 48), 0.0);
      double expected = 0.0;
      for (const LightSource& light : terrace.scene.lights)
        expected +=
            light.intensity[0] * light_at(light, {p, {0, 0, 1}, 0}, terrace.occluders).irradiance;
      EXPECT_NEAR(image.pixels[static_cast<std::size_t>(48 * y + x)].irradiance, expected,
                  0.02 * expected);
    }
  }
}

TEST(SkyPicture, ShowsTheSunsDisc) {
  Terrace terrace;
  terrace.scene.sky->sun = glm::normalize(Vec3(0.3, 1.0, 0.5));
  terrace.scene.sky->sun_illuminance = {50000.0};
  terrace.scene.lights.clear();
  make_sky_lights(terrace.scene);
  Camera camera = level();
  camera.look_at = camera.eye + terrace.scene.sky->sun;
  camera.vertical_angle_deg = 2.0;
  double sun = 0.0;  // illuminance at right angles by what the picture has more than the sky
  const LightImage image = terrace.picture(camera);
  const double side = 2.0 * std::tan(pi / 180.0) / height;
  for (const LightImage::Pixel& pixel : image.pixels)
    sun += (pixel.radiosity[0] / pi - expected_luminance(terrace.scene.sky->sun)) * side * side;
  EXPECT_NEAR(sun, 50000.0, 0.05 * 50000.0);
}

TEST(SkyPicture, DrawingsHaveNone) {
  Camera camera = level();
  camera.parallel_height_m = 3.0;
  for (const LightImage::Pixel& pixel : Terrace().picture(camera).pixels)
    EXPECT_EQ(pixel.sky, 0.0f);
}

TEST(SkyPicture, TheSkyDoesNotDarkenTheRoom) {
  LightImage image;
  image.width = 2;
  image.height = 1;
  image.pixels.resize(2);
  image.pixels[0] = {{50, 50, 50}, 100, 1, 0, 0};
  const Bitmap without = tone_mapped(image);
  image.pixels[1] = {{9000, 9000, 9000}, 0, 0, 1, 0};
  const Bitmap with = tone_mapped(image);
  EXPECT_EQ(with.pixels[0], without.pixels[0]);
  EXPECT_EQ(with.pixels[1], (Rgb8{255, 255, 255}));
}

}  // namespace
}  // namespace enfilade
