// What lights send at random is distributed as their intensity and their opening are.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "base/random.hpp"
#include "geometry/polygon.hpp"
#include "scene/light.hpp"
#include "unit/statistics.hpp"

namespace enfilade {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr std::size_t rings = 8, sectors = 8;

/// A beam that leans, brighter on one side; nothing above its horizon.
IntensityTable lopsided() {
  return {PhotometryType::c,
          {0, 90, 180, 270, 360},
          {0, 20, 40, 60, 90},
          {9, 8, 5, 1, 0, 9, 6, 3, 2, 0, 9, 4, 1, 0.5, 0, 9, 5, 4, 3, 0, 9, 8, 5, 1, 0}};
}

LightSource luminaire(OpeningShape shape) {
  LightSource light{{1.0, 2.0, 3.0}, {1.0}};
  light.distribution = std::make_shared<const IntensityDistribution>(lopsided());
  light.frame = LightFrame::of({0.3, -0.2, -1.0}, {0.0, 1.0, 0.0}).value();
  light.shape = {shape, {0.6, 0.3, 0.1}};
  make_opening(light);
  return light;
}

/// Cells of equal solid angle about z, and the share of a light's flux in each, by the midpoint
/// rule.
std::size_t cell_of(const Vec3& w) {
  const double turn = std::atan2(w.y, w.x) / two_pi + 0.5, height = 0.5 * (w.z + 1.0);
  return std::min(static_cast<std::size_t>(height * rings), rings - 1) * sectors +
         std::min(static_cast<std::size_t>(turn * sectors), sectors - 1);
}

std::vector<double> flux_shares(const LightSource& light) {
  std::vector<double> share(rings * sectors, 0.0);
  constexpr int fine = 480;
  for (int i = 0; i < fine; ++i) {
    for (int j = 0; j < fine; ++j) {
      const double z = 2.0 * (i + 0.5) / fine - 1.0, phi = two_pi * (j + 0.5) / fine,
                   r = std::sqrt(1.0 - z * z);
      const Vec3 w(r * std::cos(phi), r * std::sin(phi), z);
      share[cell_of(w)] += relative_intensity(light, w) / (double{fine} * fine);
    }
  }
  return share;
}

/// The rays carry weights, so that each cell's power is a mean: one t-test for each cell.
TEST(EmittedRay, HasTheLightsDistribution) {
  LightSource point{{0.0, 0.0, 1.0}, {1.0}};
  const std::vector<LightSource> lights{point, luminaire(OpeningShape::rectangle),
                                        spot_light({0, 0, 0}, {1, 1, -1}, {1.0}, {0.3, 0.6})};
  Random random(1);
  for (const LightSource& light : lights) {
    std::vector<testing::Samples> cells(rings * sectors);
    for (int i = 0; i < 60000; ++i) {
      const double r1 = random.uniform(), r2 = random.uniform(), r3 = random.uniform(),
                   r4 = random.uniform();
      const LightRay ray = emitted_ray(light, r1, r2, r3, r4);
      ASSERT_NEAR(glm::length(ray.direction), 1.0, 1e-9);
      const std::size_t cell = cell_of(ray.direction);
      for (std::size_t k = 0; k < cells.size(); ++k) cells[k].add(k == cell ? ray.weight : 0.0);
    }
    const std::vector<double> share = flux_shares(light);
    double whole = 0.0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      whole += cells[k].mean();
      if (share[k] < 1e-3) continue;  // too few rays for a t-test
      EXPECT_TRUE(testing::has_mean(cells[k], share[k], 3 * rings * sectors, 2e-4)) << k;
    }
    EXPECT_NEAR(whole, 1.0, 0.01);
  }
}

TEST(PointOn, IsUniformOverTheOpening) {
  Random random(2);
  for (const OpeningShape shape :
       {OpeningShape::rectangle, OpeningShape::disc, OpeningShape::box}) {
    const LightSource light = luminaire(shape);
    std::vector<double> counts, probability;
    double whole = 0.0;
    for (const Polygon& face : light.opening) whole += area_m2(face);
    // The triangles of each face about the middle of its corners.
    std::vector<Polygon> triangles;
    for (const Polygon& face : light.opening) {
      Vec3 middle(0.0);
      for (const Vec3& corner : face) middle += corner / static_cast<double>(face.size());
      for (std::size_t i = 0; i < face.size(); ++i) {
        triangles.push_back({middle, face[i], face[(i + 1) % face.size()]});
        probability.push_back(area_m2(triangles.back()) / whole);
      }
    }
    counts.resize(triangles.size(), 0.0);
    constexpr int draws = 40000;
    int found = 0;
    for (int i = 0; i < draws; ++i) {
      const double r1 = random.uniform(), r2 = random.uniform();
      const Vec3 p = point_on(light, r1, r2);
      for (std::size_t k = 0; k < triangles.size(); ++k) {
        const Polygon& t = triangles[k];
        const double parts = area_m2(Polygon{p, t[0], t[1]}) + area_m2(Polygon{p, t[1], t[2]}) +
                             area_m2(Polygon{p, t[2], t[0]});
        if (parts > area_m2(t) * (1.0 + 1e-9)) continue;
        ++counts[k];
        ++found;
        break;
      }
    }
    EXPECT_EQ(found, draws) << name_of(shape) << ": points beside the opening";
    EXPECT_TRUE(testing::are_distributed(counts, probability, 3)) << name_of(shape);
  }
}

}  // namespace
}  // namespace enfilade
