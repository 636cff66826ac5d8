#include "report/survey/glare.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/run_on_threads.hpp"
#include "geometry/clip.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "report/pictures/one_value.hpp"

namespace enfilade {
namespace {

/// A source is cut into parts of at most this solid angle, and never more often than this.
constexpr double most_part_sr = 1e-3;
constexpr int most_cuts = 10;
/// Rays to a part.
constexpr int rays_of_part = 4;
constexpr double degrees = 180.0 / std::numbers::pi;

/// An emitting polygon.
struct Source {
  std::uint32_t polygon;  ///< global number
  double luminance;       ///< cd/m2
};

std::vector<Source> sources_of(const SolvedScene& solved) {
  std::vector<Source> sources;
  for (const Cluster& cluster : solved.clusters) {
    const PatchForest& forest = solved.states[cluster.id.index()].patches();
    for (std::uint32_t k = 0; k < forest.polygons(); ++k) {
      const auto& exitance = forest.frames()[k].exitance;
      const double emitted = one_value(solved.scene, Spectrum(exitance.begin(), exitance.end()));
      if (emitted > 0.0)
        sources.push_back({solved.occluders.global(cluster.id, k), emitted / std::numbers::pi});
    }
  }
  return sources;
}

/// What an eye sees of the sources.
class Eye {
 public:
  Eye(const SolvedScene& solved, const GlarePlace& place)
      : occluders_(solved.occluders), place_(place), random_(1) {}

  void look_at(const Source& source) {
    const Polygon& polygon = occluders_.polygon(source.polygon);
    if (plane_of(polygon).signed_distance(place_.p) <= 0.0) return;
    seen_sr_ = 0.0;
    add(polygon, source, most_cuts);
    sources_ += seen_sr_ > 0.0 ? 1 : 0;
    largest_sr_ = std::max(largest_sr_, seen_sr_);
  }

  double sum() const { return sum_; }
  std::size_t sources() const { return sources_; }
  double largest_sr() const { return largest_sr_; }

 private:
  void add(const Polygon& part, const Source& source, int cuts) {
    const double whole_sr = solid_angle(place_.p, part);
    if (!(whole_sr > 0.0)) return;
    if (whole_sr > most_part_sr && cuts > 0) {
      const auto [a, b] = halves(part);
      if (a.size() >= 3 && b.size() >= 3) {
        add(a, source, cuts - 1);
        add(b, source, cuts - 1);
        return;
      }
    }
    const Vec3 direction = glm::normalize(centroid(part) - place_.p);
    if (glm::dot(direction, place_.direction) <= 0.0) return;
    double open = 0.0;
    for (int i = 0; i < rays_of_part; ++i) {
      const Vec3 at =
          uniform_point(part, (i + random_.uniform()) / rays_of_part, random_.uniform());
      open += occluders_.passage(place_.p, at, RayScene::no_polygon, source.polygon).share;
    }
    const double sr = whole_sr * open / rays_of_part;
    const double p = position_index(place_.direction, direction);
    sum_ += source.luminance * source.luminance * sr / (p * p);
    seen_sr_ += sr;
  }

  /// Cut across the longest extent.
  std::pair<Polygon, Polygon> halves(const Polygon& part) const {
    Vec3 along = part[1] - part[0];
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (std::size_t k = i + 1; k < part.size(); ++k) {
        if (glm::length(part[k] - part[i]) > glm::length(along)) along = part[k] - part[i];
      }
    }
    const Vec3 n = glm::normalize(along);
    return split(part, {n, glm::dot(n, centroid(part))}, 0.0);
  }

  const Occluders& occluders_;
  const GlarePlace& place_;
  Random random_;
  double sum_ = 0.0, seen_sr_ = 0.0, largest_sr_ = 0.0;
  std::size_t sources_ = 0;
};

GlareRating rating_of(const SurveyedScene& scene, std::span<const Source> sources,
                      const GlarePlace& place, double factor) {
  GlareRating rating{place, std::nullopt};
  Eye eye(scene.solved, rating.place);
  for (const Source& source : sources) eye.look_at(source);
  rating.sources = eye.sources();
  rating.largest_sr = eye.largest_sr();
  const PointIrradiance light = scene.gather.at(place.p, place.direction);
  const Scene& of = scene.solved.scene;
  const double indirect = one_value(of, light.irradiance) - one_value(of, light.direct);
  const double error = one_value(of, light.error);
  rating.background_cd_m2 = factor * std::max(0.0, indirect) / std::numbers::pi;
  // With less than its error there is no telling a background from none.
  if (!(indirect > error) || !(eye.sum() > 0.0)) return rating;
  const double ugr = 8.0 * std::log10(0.25 / rating.background_cd_m2 * factor * factor * eye.sum());
  rating.ugr = Estimate{ugr, 8.0 / std::numbers::ln10 * error / indirect};
  return rating;
}

}  // namespace

double position_index(const Vec3& view, const Vec3& source) {
  const Vec3 vertical = std::abs(view.z) < 0.999 ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
  const Vec3 up = glm::normalize(vertical - glm::dot(vertical, view) * view);
  const double cosine = std::clamp(glm::dot(view, source), -1.0, 1.0);
  const double sigma = degrees * std::acos(cosine);
  const Vec3 aside = source - cosine * view;
  const double off = glm::length(aside);
  if (off < 1e-12) return 1.0;
  const double height = std::clamp(glm::dot(aside, up) / off, -1.0, 1.0);
  if (height < 0.0) {
    const double slope = cosine > 0.0 ? off / cosine : 1e30;
    return std::min(16.0, 1.0 + (slope > 0.6 ? 1.2 : 0.8) * slope);
  }
  const double tau = degrees * std::acos(height);
  return std::exp((35.2 - 0.31889 * tau - 1.22 * std::exp(-2.0 * tau / 9.0)) * 1e-3 * sigma +
                  (21.0 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma);
}

std::vector<GlareRating> glare_at(const SurveyedScene& scene, std::span<const GlarePlace> places,
                                  double maintenance_factor, const Progress& progress) {
  const std::vector<Source> sources = sources_of(scene.solved);
  std::vector<GlareRating> ratings(places.size());
  for_each_on_threads(places.size(), "rooms: glare", progress, [&](std::size_t i) {
    ratings[i] = rating_of(scene, sources, places[i], maintenance_factor);
  });
  return ratings;
}

}  // namespace enfilade
