// Intensities, and the flux into polygons, against closed forms and brute force.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/polygon.hpp"
#include "geometry/sampling.hpp"
#include "photometry/distribution_json.hpp"
#include "photometry/intensity_distribution.hpp"
#include "unit/photometry/files/photometric_texts.hpp"

namespace enfilade {
namespace {

using testing::radians;
using testing::steps;

using std::numbers::pi;

IntensityDistribution of(PhotometryType type, std::vector<double> planes,
                         std::vector<double> angles, const testing::Intensity& intensity) {
  IntensityTable table{type, std::move(planes), std::move(angles), {}};
  for (const double plane : table.planes)
    for (const double angle : table.angles) table.candela.push_back(intensity(plane, angle));
  return IntensityDistribution(std::move(table));
}

/// An asymmetric beam of about 6 degrees, 25 degrees off the aim towards C = 30.
double beam(const Vec3& w) {
  const Vec3 axis(std::sin(radians(25)) * std::cos(radians(30)),
                  std::sin(radians(25)) * std::sin(radians(30)), std::cos(radians(25)));
  const double off = std::acos(std::clamp(glm::dot(axis, w) / glm::length(w), -1.0, 1.0));
  return std::exp(-std::pow(off / radians(6), 2.0)) + 0.01;
}
Vec3 direction(double c, double gamma) {
  return {std::sin(radians(gamma)) * std::cos(radians(c)),
          std::sin(radians(gamma)) * std::sin(radians(c)), std::cos(radians(gamma))};
}
IntensityDistribution beamed() {
  return of(PhotometryType::c, steps(0, 360, 5), steps(0, 180, 2.5),
            [](double c, double gamma) { return beam(direction(c, gamma)); });
}

TEST(IntensityDistribution, IsThatOfTheTableBetweenItsAngles) {
  const IntensityDistribution d = of(PhotometryType::c, {0, 90, 180}, {0, 90},
                                     [](double c, double g) { return 100.0 + c + g; });
  EXPECT_NEAR(d.intensity(direction(0, 0)), 100.0, 1e-9);
  EXPECT_NEAR(d.intensity(direction(45, 45)), 190.0, 1e-9);
  EXPECT_NEAR(d.intensity(3.0 * direction(315, 45)), 190.0, 1e-9);  // mirrored
  EXPECT_EQ(d.intensity({0.0, 0.0, -1.0}), 0.0);
}

TEST(IntensityDistribution, FluxOfUnevenPlanesIsTheIntegralOfTheIntensities) {
  const IntensityDistribution d =
      of(PhotometryType::c, {0, 30, 180, 360}, steps(0, 180, 5), [](double c, double g) {
        return (c == 30 ? 9.0 : c == 180 ? 4.0 : 1.0) * (1.0 + std::cos(radians(g)));
      });
  constexpr int n = 400;
  double flux = 0.0;  // by squares of equal solid angle
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const double z = 1.0 - 2.0 * (i + 0.5) / n;
      flux += 4.0 * pi / (n * n) *
              d.intensity(direction(360.0 * (k + 0.5) / n, std::acos(z) * 180.0 / pi));
    }
  }
  EXPECT_NEAR(d.flux(), flux, 1e-3 * flux);
}

TEST(IntensityDistribution, TypesAAndBTurnAboutTheirOwnAxes) {
  // In both, 0 and 0 is the aim, horizontal angles go to the right (x), vertical ones up (y).
  for (const PhotometryType type : {PhotometryType::a, PhotometryType::b}) {
    const IntensityDistribution d =
        of(type, steps(-90, 90, 1), steps(-90, 90, 1), [&](double plane, double angle) {
          const double h = type == PhotometryType::a ? plane : angle;
          const double v = type == PhotometryType::a ? angle : plane;
          return std::max(0.0, 90.0 + h + 0.1 * v);
        });
    const double s = std::sin(radians(30)), c = std::cos(radians(30));
    EXPECT_NEAR(d.intensity({0, 0, 1}), 90.0, 1e-9);
    EXPECT_NEAR(d.intensity({s, 0, c}), 120.0, 1e-9);
    EXPECT_NEAR(d.intensity({-s, 0, c}), 60.0, 1e-9);
    EXPECT_NEAR(d.intensity({0, s, c}), 93.0, 1e-9);
  }
}

TEST(FluxWithin, IsTheSolidAngleOfAnEvenLight) {
  const IntensityDistribution even =
      of(PhotometryType::c, {0}, steps(0, 180, 5), [](double, double) { return 1.0; });
  EXPECT_NEAR(even.flux(), 4.0 * pi, 1e-9);
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 n = sphere_direction(2.0 * random.uniform() - 1.0, random.uniform());
    const Vec3 u = glm::normalize(glm::cross(n, Vec3(0.3, 0.5, 0.8))), v = glm::cross(n, u);
    const Vec3 at = n * (0.1 + random.uniform()) + u * random.uniform();
    const Polygon square{at, at + u, at + u + v, at + v};
    EXPECT_NEAR(even.flux_within(square), solid_angle(Vec3(0.0), square), 1e-4);
  }
}

TEST(FluxWithin, SumsToTheWholeOverAClosedBox) {
  for (const IntensityDistribution& d :
       {beamed(), spot_distribution(radians(1), radians(2)),
        of(PhotometryType::b, steps(-90, 90, 2), steps(0, 90, 2), [](double v, double h) {
          return std::pow(std::cos(radians(v)) * std::cos(radians(h)), 9);
        })}) {
    const Vec3 lo(-1.3, -2.1, -0.4), hi(2.2, 0.9, 3.1);
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double at : {lo[axis], hi[axis]}) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        Polygon face(4, Vec3(0.0));
        for (std::size_t i = 0; i < 4; ++i) {
          face[i][axis] = at;
          face[i][a] = i == 0 || i == 3 ? lo[a] : hi[a];
          face[i][b] = i < 2 ? lo[b] : hi[b];
        }
        sum += d.flux_within(face);
      }
    }
    EXPECT_NEAR(sum, d.flux(), 2e-4 * d.flux());
  }
}

TEST(FluxWithin, AgreesWithBruteForceWhereABeamMeetsAPolygon) {
  const IntensityDistribution d = beamed();
  const Polygon floor{{0.2, -0.3, 2.0}, {1.4, -0.2, 2.0}, {1.1, 0.9, 2.0}, {0.1, 0.8, 2.0}};
  constexpr int n = 600;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double s = (i + 0.5) / n, t = (j + 0.5) / n;
      const Vec3 along = (1.0 - t) * (floor[1] - floor[0]) + t * (floor[2] - floor[3]);
      const Vec3 across = (1.0 - s) * (floor[3] - floor[0]) + s * (floor[2] - floor[1]);
      const Vec3 p = (1.0 - t) * ((1.0 - s) * floor[0] + s * floor[1]) +
                     t * ((1.0 - s) * floor[3] + s * floor[2]);
      const double r = glm::length(p), area = std::abs(glm::cross(along, across).z) / (n * n);
      sum += d.intensity(p) * p.z / (r * r * r) * area;
    }
  }
  EXPECT_NEAR(d.flux_within(floor), sum, 2e-4 * sum);
}

TEST(IntensityDistribution, IsBoundedWithinCones) {
  const IntensityDistribution d = beamed();
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 axis = sphere_direction(2.0 * random.uniform() - 1.0, random.uniform());
    const double half = random.uniform();
    const double most = d.most_within({axis, half});
    const Vec3 v = glm::normalize(glm::cross(axis, Vec3(0.2, 0.9, 0.4)));
    const double off = half * random.uniform();
    EXPECT_LE(d.intensity(std::cos(off) * axis + std::sin(off) * v), most * (1 + 1e-12));
  }
}

TEST(IntensityDistribution, IsSampledInProportion) {
  const IntensityDistribution d = beamed();
  constexpr int n = 400'000;
  double weights = 0.0, within = 0.0;
  const Polygon floor{{0.2, -0.3, 2.0}, {1.4, -0.2, 2.0}, {1.1, 0.9, 2.0}, {0.1, 0.8, 2.0}};
  for (int i = 0; i < n; ++i) {
    const SampledDirection s = d.sample((i + 0.5) / n, std::fmod(0.6180339887498949 * i, 1.0));
    EXPECT_NEAR(glm::length(s.toward), 1.0, 1e-9);
    weights += s.weight / n;
    if (s.toward.z > 0.0 && contains(floor, Vec3(0, 0, 1), s.toward * (2.0 / s.toward.z)))
      within += s.weight / n;
  }
  EXPECT_NEAR(weights, 1.0, 0.002);
  EXPECT_NEAR(within, d.flux_within(floor) / d.flux(), 0.005 * within);
}

TEST(SpotDistribution, HasTheFluxOfItsClosedForm) {
  for (const auto& [inner, outer] : {std::pair{0.0, 0.7}, {0.3, 0.4}, {0.0, 0.02}, {0.5, 1.5}}) {
    const IntensityDistribution spot = spot_distribution(inner, outer);
    const double a = std::cos(inner), b = std::cos(outer);
    const double flux = 2.0 * pi * ((1.0 - a) + (a - b) / 3.0);
    EXPECT_NEAR(spot.flux(), flux, 2e-4 * flux);
    EXPECT_NEAR(spot.intensity({0, 0, 1}), 1.0, 1e-12);
    EXPECT_EQ(spot.intensity({std::sin(outer + 0.01), 0, std::cos(outer + 0.01)}), 0.0);
  }
}

TEST(IntensityDistribution, LosesWhatGoesToTheBack) {
  const IntensityDistribution front = beamed().front_half();
  EXPECT_EQ(front.intensity({0.1, 0, -1}), 0.0);
  EXPECT_NEAR(front.intensity({0.1, 0.2, 1}), beamed().intensity({0.1, 0.2, 1}), 1e-12);
}

TEST(DistributionJson, ReadsWhatItWrites) {
  const InlineDistribution source{std::make_shared<const IntensityDistribution>(beamed()),
                                  {OpeningShape::box, {0.6, 0.3, 0.1}}};
  const auto text = to_json(source).dump();
  const InlineDistribution back =
      distribution_from_json(nlohmann::json::parse(text), "scene.json", "distribution");
  EXPECT_EQ(back.distribution->table().candela, source.distribution->table().candela);
  EXPECT_DOUBLE_EQ(back.distribution->flux(), source.distribution->flux());
  EXPECT_EQ(back.opening.shape, OpeningShape::box);
  EXPECT_EQ(back.opening.size, source.opening.size);
}

}  // namespace
}  // namespace enfilade
