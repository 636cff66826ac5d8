#include "scene/sky.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/form_factor.hpp"
#include "scene/scene_scale.hpp"

namespace enfilade {
namespace {

using std::numbers::pi;

/// a, b, c, d, e of the types 1 to 15 (ISO 15469:2004, table 1).
constexpr std::array<std::array<double, 5>, 15> types{{{4.0, -0.70, 0.0, -1.0, 0.00},
                                                       {4.0, -0.70, 2.0, -1.5, 0.15},
                                                       {1.1, -0.80, 0.0, -1.0, 0.00},
                                                       {1.1, -0.80, 2.0, -1.5, 0.15},
                                                       {0.0, -1.00, 0.0, -1.0, 0.00},
                                                       {0.0, -1.00, 2.0, -1.5, 0.15},
                                                       {0.0, -1.00, 5.0, -2.5, 0.30},
                                                       {0.0, -1.00, 10.0, -3.0, 0.45},
                                                       {-1.0, -0.55, 2.0, -1.5, 0.15},
                                                       {-1.0, -0.55, 5.0, -2.5, 0.30},
                                                       {-1.0, -0.55, 10.0, -3.0, 0.45},
                                                       {-1.0, -0.32, 10.0, -3.0, 0.45},
                                                       {-1.0, -0.32, 16.0, -3.0, 0.30},
                                                       {-1.0, -0.15, 16.0, -3.0, 0.30},
                                                       {-1.0, -0.15, 24.0, -2.8, 0.15}}};

/// How far the dome is, in diagonals of the scene: directions to it differ by 1e-5 at most between
/// places of the scene.
constexpr double dome_distance = 1e5;
/// Facets of a dome: rings of equal angle from the zenith, each of so many.
constexpr int rings = 12, facets_of_ring = 36;
constexpr double sun_radius = 0.2665 * pi / 180.0;  ///< half the disc's mean apparent diameter
constexpr int sun_corners = 24;

/// Two unit vectors at right angles to each other and to `up`.
std::pair<Vec3, Vec3> across(const Vec3& up) {
  const Vec3 any = std::abs(up.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(up, any));
  return {u, glm::cross(up, u)};
}

Vec3 direction(const Vec3& up, double from_zenith, double azimuth) {
  const auto [u, v] = across(up);
  return std::cos(from_zenith) * up +
         std::sin(from_zenith) * (std::cos(azimuth) * u + std::sin(azimuth) * v);
}

/// The ball around the scene, which a dome's light is sent to.
struct Ball {
  Vec3 center{0.0};
  double radius_m = 0.0;
};

/// A dome about `up`, whose facets face its middle.
std::vector<Polygon> dome(const Vec3& up, const Ball& ball) {
  const double far_m = 2.0 * dome_distance * ball.radius_m;
  const auto corner = [&](int ring, int k) {
    const double turn = 2.0 * pi * (k % facets_of_ring) / facets_of_ring;
    return ball.center + far_m * direction(up, 0.5 * pi * ring / rings, turn);
  };
  std::vector<Polygon> facets;
  // Quarter by quarter and ring by ring, so that half a list is a part of the sky that holds
  // together.
  constexpr int sector = facets_of_ring / 4;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (int ring = 0; ring < rings; ++ring) {
      for (int k = quarter * sector; k < (quarter + 1) * sector; ++k) {
        Polygon facet{corner(ring, k), corner(ring + 1, k), corner(ring + 1, k + 1)};
        if (ring > 0) facet.push_back(corner(ring, k + 1));
        if (glm::dot(normal(facet), ball.center - facet[0]) < 0.0)
          std::reverse(facet.begin(), facet.end());
        facets.push_back(std::move(facet));
      }
    }
  }
  return facets;
}

/// The mean over a facet of the shape's luminance: of three points of each triangle of its fan,
/// which is cut `cuts` times into four.
double mean_over(const Sky& sky, const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c,
                 int cuts) {
  const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  if (cuts == 0)
    return (sky.relative(ab - from) + sky.relative(bc - from) + sky.relative(ca - from)) / 3.0;
  return 0.25 *
         (mean_over(sky, from, a, ab, ca, cuts - 1) + mean_over(sky, from, ab, b, bc, cuts - 1) +
          mean_over(sky, from, ca, bc, c, cuts - 1) + mean_over(sky, from, ab, bc, ca, cuts - 1));
}

/// A light of a dome; its `intensity` stands for the luminance `per_band` times `sky.relative`.
LightSource dome_light(const Sky& sky, const Ball& ball, const std::vector<double>& per_band,
                       const char* name) {
  LightSource light;
  light.p = ball.center;
  light.name = name;
  light.sky = std::make_shared<const Sky>(sky);
  light.far_m = 2.0 * dome_distance * ball.radius_m;
  light.reach_m = ball.radius_m;
  light.opening = dome(sky.zenith, ball);
  double all = 0.0;
  for (const Polygon& facet : light.opening) {
    double sum = 0.0, areas = 0.0;
    for (std::size_t i = 2; i < facet.size(); ++i) {
      const double m2 = area_m2(Polygon{facet[0], facet[i - 1], facet[i]});
      sum += m2 * mean_over(sky, ball.center, facet[0], facet[i - 1], facet[i], 3);
      areas += m2;
    }
    const Vec3 d = centroid(facet) - ball.center;
    light.shares.push_back(sum / areas * solid_angle(ball.center, facet) * glm::dot(d, d));
    all += light.shares.back();
  }
  for (double& share : light.shares) share /= all;
  light.luminance_per_intensity = 1.0 / all;
  for (const double luminance : per_band) light.intensity.push_back(luminance * all);
  return light;
}

LightSource sun_light(const Sky& sky, const Ball& ball) {
  LightSource light;
  light.name = "sun";
  light.far_m = 2.0 * dome_distance * ball.radius_m;
  light.reach_m = ball.radius_m;
  light.p = ball.center + light.far_m * sky.sun;
  Polygon& disc = light.opening.emplace_back();
  // Of the same area as the round disc.
  const double radius_m = light.far_m * std::tan(sun_radius) *
                          std::sqrt(2.0 * pi / (sun_corners * std::sin(2.0 * pi / sun_corners)));
  const auto [u, v] = across(-sky.sun);
  for (int k = 0; k < sun_corners; ++k) {
    const double turn = 2.0 * pi * k / sun_corners;
    disc.push_back(light.p + radius_m * (std::cos(turn) * u + std::sin(turn) * v));
  }
  light.frame = LightFrame::of(-sky.sun);
  for (const double e : sky.sun_illuminance)
    light.intensity.push_back(e * light.far_m * light.far_m);
  return light;
}

}  // namespace

SkyShape SkyShape::of_type(int type) {
  const auto& t = types.at(static_cast<std::size_t>(type - 1));
  return {t[0], t[1], t[2], t[3], t[4], false};
}

double SkyShape::relative(const Vec3& toward, const Vec3& zenith, const Vec3& sun) const {
  const Vec3 w = glm::normalize(toward);
  const double height = std::max(0.0, glm::dot(w, zenith));
  if (overcast) return (1.0 + 2.0 * height) / 3.0;
  const auto gradation = [&](double cosine) {
    return 1.0 + (cosine > 0.0 ? a * std::exp(b / cosine) : 0.0);
  };
  const auto indicatrix = [&](double cosine) {
    const double chi = std::acos(std::clamp(cosine, -1.0, 1.0));
    return 1.0 + c * (std::exp(d * chi) - std::exp(d * 0.5 * pi)) + e * cosine * cosine;
  };
  return gradation(height) * indicatrix(glm::dot(w, sun)) /
         (gradation(1.0) * indicatrix(glm::dot(zenith, sun)));
}

/// Midpoints of strips of equal cosine-weighted solid angle, finer than any sky varies.
double Sky::horizontal_per_zenith() const {
  constexpr int steps = 512;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double from_zenith = std::asin(std::sqrt((i + 0.5) / steps));
    for (int k = 0; k < steps; ++k)
      sum += relative(direction(zenith, from_zenith, 2.0 * pi * (k + 0.5) / steps));
  }
  return pi * sum / (static_cast<double>(steps) * steps);
}

std::vector<double> Sky::horizontal(bool with_sun) const {
  std::vector<double> e(zenith_luminance);
  const double per_zenith = horizontal_per_zenith();
  for (std::size_t band = 0; band < e.size(); ++band) {
    e[band] *= per_zenith;
    if (with_sun && !sun_illuminance.empty())
      e[band] += sun_illuminance[band] * std::max(0.0, glm::dot(sun, zenith));
  }
  return e;
}

std::vector<double> far_luminance(std::span<const LightSource> lights, const Vec3& direction) {
  const Vec3 toward = glm::normalize(direction);
  std::vector<double> luminance;
  for (const LightSource& light : lights) {
    if (!light.is_far()) continue;
    luminance.resize(light.intensity.size(), 0.0);
    double per_intensity = 0.0;
    if (light.sky) {
      if (glm::dot(toward, light.sky->zenith) > 0.0)
        per_intensity = light.luminance_per_intensity * light.sky->relative(toward);
    } else if (glm::dot(toward, -light.frame.aim) > std::cos(sun_radius)) {
      // A disc of this area, seen at right angles, gives the illuminance intensity / far_m^2.
      const double tangent = std::tan(sun_radius);
      per_intensity = 1.0 / (pi * tangent * tangent * light.far_m * light.far_m);
    }
    for (std::size_t b = 0; b < luminance.size(); ++b)
      luminance[b] += per_intensity * light.intensity[b];
  }
  return luminance;
}

void make_sky_lights(Scene& scene) {
  if (!scene.sky) return;
  const Sky& sky = *scene.sky;
  const Box box = SceneScale(scene).box();
  const Ball ball{box.center(), 0.5 * box.diagonal()};
  scene.lights.push_back(dome_light(sky, ball, sky.zenith_luminance, "sky"));
  const auto any = [](const std::vector<double>& bands) {
    return std::ranges::any_of(bands, [](double b) { return b > 0.0; });
  };
  if (any(sky.ground_reflectance)) {
    Sky ground;
    ground.zenith = -sky.zenith;
    std::vector<double> luminance = sky.horizontal(true);
    for (std::size_t band = 0; band < luminance.size(); ++band)
      luminance[band] *= sky.ground_reflectance[band] / pi;
    scene.lights.push_back(dome_light(ground, ball, luminance, "ground"));
  }
  if (any(sky.sun_illuminance)) scene.lights.push_back(sun_light(sky, ball));
}

}  // namespace enfilade
