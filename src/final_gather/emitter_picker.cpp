#include "final_gather/emitter_picker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/kernel_sample.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

/// Rays from all lamps together, and from one.
constexpr int all_rays = 1 << 16, least_rays = 64, most_rays = 4096;
/// Probability of a pick by the lamps' rays, where any of them lit the polygon.
constexpr double by_rays = 0.8;

double largest(const Spectrum& bands) { return *std::max_element(bands.begin(), bands.end()); }

}  // namespace

EmitterPicker::EmitterPicker(std::span<const EmitterSampler::Emitter> emitters,
                             std::span<const LightSource> lights, const Occluders& occluders,
                             std::uint64_t seed)
    : emitters_(emitters), lights_(lights), occluders_(&occluders) {
  for (const LightSource& light : lights) {
    double radius_m = 0.0;
    for (const Polygon& part : light.opening) {
      for (const Vec3& corner : part) radius_m = std::max(radius_m, glm::length(corner - light.p));
    }
    radius_m_.push_back(radius_m);
  }
  std::vector<Arrival> arrivals;
  const auto lamps = static_cast<std::uint32_t>(size());
  for (std::uint32_t lamp = 0; lamp < lamps && lamps > 1; ++lamp) {
    Random random((seed << 32) + lamp);
    shoot(lamp, std::clamp(all_rays / static_cast<int>(lamps), least_rays, most_rays), random,
          arrivals);
  }
  std::sort(arrivals.begin(), arrivals.end());
  arrivals.erase(std::unique(arrivals.begin(), arrivals.end()), arrivals.end());
  first_.push_back(0);
  for (const Arrival& arrival : arrivals) {
    while (first_.size() <= arrival.polygon)
      first_.push_back(static_cast<std::uint32_t>(lit_.size()));
    lit_.push_back(arrival.lamp);
  }
  first_.push_back(static_cast<std::uint32_t>(lit_.size()));
}

void EmitterPicker::shoot(std::uint32_t lamp, int rays, Random& random,
                          std::vector<Arrival>& arrivals) const {
  for (int i = 0; i < rays; ++i) {
    const double r1 = (i + random.uniform()) / rays, r2 = random.uniform();
    const double r3 = random.uniform(), r4 = random.uniform();
    RayHit hit;
    if (lamp < emitters_.size()) {
      const EmitterSampler::Emitter& b = emitters_[lamp];
      const PolygonFrame& frame = b.frame();
      const PatchShape& shape = b.shape();
      const Vec3 from = frame.at(
          uniform_point({shape.vertices.data(), shape.vertices.size()}, shape.area_m2, r3, r4));
      hit = occluders_->rays().closest(from, cosine_direction(frame.n, r1, r2), b.polygon);
    } else {
      const LightRay ray = emitted_ray(lights_[lamp - emitters_.size()], r1, r2, r3, r4);
      if (ray.weight <= 0.0) continue;
      hit = occluders_->rays().closest(ray.from, ray.direction);
    }
    if (hit.any() && hit.front) arrivals.push_back({hit.polygon, lamp});
  }
}

std::span<const std::uint32_t> EmitterPicker::lit(std::uint32_t polygon) const {
  if (std::size_t{polygon} + 1 >= first_.size()) return {};
  return {lit_.data() + first_[polygon], lit_.data() + first_[polygon + 1]};
}

std::vector<double> EmitterPicker::weights(const Vec3& p) const {
  std::vector<double> sums;
  double sum = 0.0;
  for (const EmitterSampler::Emitter& b : emitters_) {
    const PatchShape& shape = b.shape();
    const Vec3 d = b.center() - p;
    sum += b.largest_radiosity * shape.area_m2 / (glm::dot(d, d) + shape.area_m2);
    sums.push_back(sum);
  }
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const Vec3 d = lights_[i].p - p;
    const double near_m = occluders_->rays().epsilon_m() + radius_m_[i];
    sum += std::numbers::pi * largest(lights_[i].intensity) / (glm::dot(d, d) + near_m * near_m);
    sums.push_back(sum);
  }
  return sums;
}

/// About the irradiance (largest band) that the lamp would bring if nothing hid it.
double EmitterPicker::unoccluded(std::uint32_t lamp, const LitPlace& place) const {
  if (lamp < emitters_.size()) {
    const EmitterSampler::Emitter& b = emitters_[lamp];
    if (b.polygon == place.own) return 0.0;
    const PolygonFrame& frame = b.frame();
    const double area_m2 = b.shape().area_m2;
    const Vec3 d = b.center() - place.x;
    const double r2 = glm::dot(d, d), size_m = std::sqrt(b.size2);
    // A part of a near emitter may be above the horizon, or before its plane, where its middle is
    // not.
    const double received = glm::dot(place.n, d) + size_m, sent = -glm::dot(frame.n, d);
    if (received <= 0.0 || sent <= 0.0) return 0.0;
    const double near_m2 = r2 + area_m2;
    return b.largest_radiosity * area_m2 * std::min(received, std::sqrt(near_m2)) * sent /
           (std::numbers::pi * near_m2 * near_m2);
  }
  const LightSource& light = lights_[lamp - emitters_.size()];
  const Vec3 d = light.p - place.x;
  const double near_m = occluders_->rays().epsilon_m() + radius_m_[lamp - emitters_.size()];
  const double r2 = glm::dot(d, d) + near_m * near_m;
  return largest(light.intensity) * std::max(0.0, glm::dot(place.n, d) + near_m) /
         (r2 * std::sqrt(r2));
}

/// Adds share * an estimate, by one ray, of the emitter's light at the place. Its light may vary,
/// as over a wall beside a window, and so may what hides it: the ray ends where the place sees much
/// of it, and brings the radiosity that is there.
void EmitterPicker::add_emitter(const EmitterSampler::Emitter& emitter, const LitPlace& place,
                                Random& random, std::span<const double> share,
                                Spectrum& irradiance) const {
  const PolygonFrame& frame = emitter.frame();
  if (emitter.polygon == place.own || glm::dot(frame.n, place.x - frame.origin) <= 0.0) return;
  const KernelSample end = sample_by_kernel(place.x, place.n, emitter.corners, random);
  if (end.weight <= 0.0) return;
  const Passage passage =
      occluders_->passage(place.x, end.at, place.own, emitter.polygon, place.start);
  if (passage.share <= 0.0) return;
  std::vector<double> radiosity(irradiance.size());
  emitter.forest->evaluate(true, emitter.node, end.at, radiosity);
  for (std::size_t band = 0; band < irradiance.size(); ++band)
    irradiance[band] += share[band] * end.weight * passage.band(band) * radiosity[band];
}

void EmitterPicker::add_picked(const LitPlace& place, std::span<const double> weights,
                               Random& random, std::span<const double> share,
                               Spectrum& irradiance) const {
  if (size() == 0 || weights.back() <= 0.0) return;
  const std::span<const std::uint32_t> known = lit(place.own);
  double sum = 0.0;
  for (const std::uint32_t l : known) sum += unoccluded(l, place);
  const double guided = sum > 0.0 ? by_rays : 0.0;
  std::uint32_t lamp = 0;
  double pick = random.uniform();
  if (pick < guided) {
    pick *= sum / guided;
    for (const std::uint32_t l : known) {
      const double weight = unoccluded(l, place);
      if (weight > 0.0) lamp = l;
      if (pick < weight) break;
      pick -= weight;
    }
  } else {
    pick = (pick - guided) / (1.0 - guided) * weights.back();
    const auto at = std::upper_bound(weights.begin(), weights.end(), pick) - weights.begin();
    lamp = static_cast<std::uint32_t>(std::min(static_cast<std::size_t>(at), size() - 1));
  }
  double chance =
      (1.0 - guided) * (weights[lamp] - (lamp > 0 ? weights[lamp - 1] : 0.0)) / weights.back();
  if (guided > 0.0 && std::binary_search(known.begin(), known.end(), lamp))
    chance += guided * unoccluded(lamp, place) / sum;
  if (lamp < emitters_.size()) {
    std::vector<double> of_picked(share.begin(), share.end());
    for (double& s : of_picked) s /= chance;
    add_emitter(emitters_[lamp], place, random, of_picked, irradiance);
    return;
  }
  const LightSource& light = lights_[lamp - emitters_.size()];
  const double r1 = light.opening.empty() ? 0.0 : random.uniform();
  const double r2 = light.opening.empty() ? 0.0 : random.uniform();
  const LightAtPoint found = light_by_one_ray(light, place, *occluders_, r1, r2);
  for (std::size_t band = 0; band < irradiance.size(); ++band)
    irradiance[band] += share[band] * light.intensity[band] * found.band(band) / chance;
}

}  // namespace enfilade
