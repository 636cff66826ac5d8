#include "final_gather/emitter_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

/// Of a bright emitter's mean radiosity to the mean of all surfaces: a ray that hits the emitter by
/// chance brings so many times what a ray brings on average.
constexpr double bright_ratio = 8.0;
/// Share of the bright emitters' unoccluded light at a point below which a part of one that is
/// behind many polygons is sampled. There are at most some 2 / smallest_part such parts: with 8
/// rays each, their noise is below 0.4% of that light.
constexpr double smallest_part = 5e-4;
/// A polygon this many times its size away, squared, weighs as much as its middle does.
constexpr double far_areas = 16.0;
/// Share of the bright emitters' unoccluded light at a point below which one is left out.
constexpr double negligible = 1e-6;

double largest_radiosity(const PatchForest& f, std::size_t k) {
  const auto terms = static_cast<std::size_t>(f.terms());
  double largest = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(f.lead_bands()) * terms; i += terms) {
    largest = std::max(largest, f.radiosity(k)[i]);
  }
  return largest;
}

}  // namespace

EmitterSampler::EmitterSampler(std::span<const ClusterState> clusters, const Occluders& occluders)
    : clusters_(clusters), occluders_(&occluders) {
  double area = 0.0, power = 0.0;
  std::size_t polygons = 0;
  for (const ClusterState& c : clusters) {
    const PatchForest& f = c.patches();
    polygons += f.polygons();
    for (std::size_t k = 0; k < f.polygons(); ++k) {
      area += f.node(k).shape.area_m2;
      power += f.node(k).shape.area_m2 * largest_radiosity(f, k);
    }
  }
  is_bright_.assign(polygons, false);
  const double limit = area > 0.0 ? bright_ratio * power / area : 0.0;
  for (const ClusterState& c : clusters) {
    const PatchForest& f = c.patches();
    for (std::uint32_t k = 0; k < f.polygons(); ++k) {
      const double largest = largest_radiosity(f, k);
      if (largest <= 0.0) continue;
      const std::uint32_t number = occluders.global(c.id(), k);
      is_bright_[number] = largest > limit;
      (largest > limit ? bright_ : others_)
          .push_back({number, &f, k, corners_of(f.frames()[k], f.node(k).shape), largest, 0.0});
      Emitter& added = (largest > limit ? bright_ : others_).back();
      for (const Vec3& corner : added.corners) {
        const Vec3 d = corner - f.frames()[k].origin;
        added.size2 = std::max(added.size2, glm::dot(d, d));
      }
    }
  }
}

/// The irradiance (largest band) that each polygon would give at p if nothing hid it.
std::vector<double> EmitterSampler::unoccluded(const std::vector<Emitter>& polygons, const Vec3& p,
                                               const Vec3& n, std::uint32_t own) {
  std::vector<double> weight(polygons.size(), 0.0);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const Emitter& b = polygons[i];
    const PolygonFrame& frame = b.forest->frames()[b.k];
    const Vec3 d = frame.origin - p;  // from the polygon's centroid
    const double sent = -glm::dot(frame.n, d), r2 = glm::dot(d, d);
    if (b.polygon == own || sent <= 0.0) continue;
    const double m2 = b.forest->node(b.k).shape.area_m2, received = glm::dot(n, d);
    // Far away the kernel to the middle will do; near the horizon a part may still be above it.
    const bool is_far = r2 > far_areas * b.size2;
    if (is_far && received < -std::sqrt(b.size2)) continue;
    weight[i] = b.largest_radiosity * (is_far && received > std::sqrt(b.size2)
                                           ? m2 * received * sent / (std::numbers::pi * r2 * r2)
                                           : point_to_polygon(p, n, b.corners));
  }
  return weight;
}

/// Mean radiosity of the other polygons that are not controlled, by their unoccluded form factors.
Spectrum EmitterSampler::ambient(std::span<const double> unoccluded, const ControlVariate& control,
                                 std::size_t bands) const {
  Spectrum sum(bands, 0.0);
  double factors = 0.0;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const Emitter& b = others_[i];
    if (unoccluded[i] <= 0.0 || control.find(b.polygon) != nullptr) continue;
    const double factor = unoccluded[i] / b.largest_radiosity;
    factors += factor;
    for (std::size_t band = 0; band < bands; ++band) sum[band] += factor * b.radiosity(band);
  }
  for (double& s : sum) s = factors > 0.0 ? s / factors : 0.0;
  return sum;
}

const EmitterSampler::ControlledPolygon* EmitterSampler::ControlVariate::find(
    std::uint32_t polygon) const {
  const auto at = std::lower_bound(polygons.begin(), polygons.end(), polygon,
                                   [](const ControlledPolygon& controlled, std::uint32_t number) {
                                     return controlled.polygon < number;
                                   });
  return at != polygons.end() && at->polygon == polygon ? &*at : nullptr;
}

EmitterSampler::ControlVariate EmitterSampler::add_control_variate(const Vec3& p, const Vec3& n,
                                                                   std::uint32_t own, double least,
                                                                   Random& random,
                                                                   Spectrum& irradiance,
                                                                   Spectrum& variance) const {
  ControlVariate control;
  const std::vector<double> bright = unoccluded(bright_, p, n, own);
  const std::vector<double> other = unoccluded(others_, p, n, own);
  const double total_bright = std::accumulate(bright.begin(), bright.end(), 0.0);
  const double total = std::accumulate(other.begin(), other.end(), total_bright);
  VisibleNodes visible(*occluders_);
  ControlledPolygon next;
  const auto find_exactly = [&](const Emitter& b) {
    next.polygon = b.polygon;
    return visible.find(p, n, own, occluders_->local(b.polygon).cluster, *b.forest, b.k,
                        least * total, next.nodes);
  };
  for (std::size_t i = 0; i < bright_.size(); ++i) {
    if (bright[i] <= negligible * total_bright || bright[i] <= 0.0) continue;
    const Emitter& b = bright_[i];
    if (!find_exactly(b)) {
      next.nodes.resize(1);
      const double variance_of_factor = visible.find_by_parts(
          p, n, own, occluders_->local(b.polygon).cluster, *b.forest, b.k, least * total,
          smallest_part * total_bright / b.largest_radiosity, random, next.nodes.front());
      for (std::size_t band = 0; band < variance.size(); ++band)
        variance[band] += variance_of_factor * b.radiosity(band) * b.radiosity(band);
    }
    control.polygons.push_back(next);
  }
  for (std::size_t i = 0; i < others_.size(); ++i) {
    if (other[i] > least * total && find_exactly(others_[i])) control.polygons.push_back(next);
  }
  std::sort(
      control.polygons.begin(), control.polygons.end(),
      [](const ControlledPolygon& a, const ControlledPolygon& b) { return a.polygon < b.polygon; });
  control.ambient = ambient(other, control, irradiance.size());
  for (std::size_t band = 0; band < irradiance.size(); ++band) {
    irradiance[band] += control.ambient[band];
  }
  for (const ControlledPolygon& polygon : control.polygons) {
    const PatchForest& forest =
        clusters_[occluders_->local(polygon.polygon).cluster.index()].patches();
    for (const VisibleNode& node : polygon.nodes) {
      for (std::size_t band = 0; band < irradiance.size(); ++band) {
        irradiance[band] += node.irradiance(forest, band) - node.factor * control.ambient[band];
      }
    }
  }
  return control;
}

void EmitterSampler::add_emitted(const ControlVariate& control, Spectrum& irradiance) const {
  for (const ControlledPolygon& polygon : control.polygons) {
    const PolygonRef ref = occluders_->local(polygon.polygon);
    const PolygonFrame& frame = clusters_[ref.cluster.index()].patches().frames()[ref.polygon];
    double factor = 0.0;
    for (const VisibleNode& node : polygon.nodes) factor += node.factor;
    for (std::size_t band = 0; band < irradiance.size(); ++band)
      irradiance[band] += factor * frame.exitance[band];
  }
}

std::vector<double> EmitterSampler::pick_weights(const Vec3& p) const {
  std::vector<double> sums;
  double sum = 0.0;
  for (const Emitter& b : bright_) {
    const PatchShape& shape = b.forest->node(b.k).shape;
    const Vec3 d = b.forest->frames()[b.k].at(shape.centroid) - p;
    sum += b.largest_radiosity * shape.area_m2 / (glm::dot(d, d) + shape.area_m2);
    sums.push_back(sum);
  }
  return sums;
}

void EmitterSampler::add_picked(const Vec3& p, const Vec3& n, std::uint32_t own,
                                std::span<const double> weights, Random& random,
                                std::span<const double> share, Spectrum& irradiance) const {
  if (bright_.empty()) return;
  const double pick = random.uniform() * weights.back();
  const auto at = std::upper_bound(weights.begin(), weights.end(), pick) - weights.begin();
  const std::size_t i = std::min(static_cast<std::size_t>(at), bright_.size() - 1);
  const Emitter& b = bright_[i];
  const double r1 = random.uniform(), r2 = random.uniform();
  const int quarter = static_cast<int>(random.below(4));
  const PolygonFrame& frame = b.forest->frames()[b.k];
  if (b.polygon == own || glm::dot(frame.n, p - frame.origin) <= 0.0) return;
  const double factor = point_to_polygon(p, n, b.corners);
  if (factor <= 0.0) return;
  const Vec3 y = frame.at(b.forest->node(b.k).shape.point_in_quarter(quarter, r1, r2));
  if (occluders_->rays().occluded(p, y, own, b.polygon, RayStart::in_air)) return;
  const double chance = (weights[i] - (i > 0 ? weights[i - 1] : 0.0)) / weights.back();
  for (std::size_t band = 0; band < irradiance.size(); ++band) {
    irradiance[band] += share[band] * factor / chance * b.radiosity(band);
  }
}

}  // namespace enfilade
