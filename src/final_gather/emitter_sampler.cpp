#include "final_gather/emitter_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "final_gather/mean_light.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"

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
constexpr double negligible_emitter = 1e-6;
/// Of the bright emitters' unoccluded light: what is taken for the light at a point at least.
constexpr double least_seen = 1e-3;
/// Polygons that are not bright and controlled all the same.
constexpr std::size_t most_controlled = 64;
/// Of the noise allowed: what the polygons that are left to the rays may give.
constexpr double rays_share = 0.5;

}  // namespace

EmitterSampler::EmitterSampler(std::span<const ClusterState> clusters, const Occluders& occluders)
    : clusters_(clusters), occluders_(&occluders) {
  std::size_t polygons = 0;
  for (const ClusterState& c : clusters) polygons += c.patches().polygons();
  is_bright_.assign(polygons, false);
  const double limit = bright_ratio * mean_radiosity_over(clusters);
  for (const ClusterState& c : clusters) {
    const PatchForest& f = c.patches();
    OtherGroup group{others_.size(), others_.size(), {}};
    for (std::uint32_t k = 0; k < f.polygons(); ++k) {
      const double largest = largest_radiosity(f, k);
      if (largest <= 0.0) continue;
      const std::uint32_t number = occluders.global(c.id(), k);
      is_bright_[number] = largest > limit;
      Emitter& added =
          (is_bright_[number] ? bright_ : others_)
              .emplace_back(
                  Emitter{number, &f, k, corners_of(f.frames()[k], f.node(k).shape), largest, 0.0});
      for (const Vec3& corner : added.corners) {
        const Vec3 d = corner - added.center();
        added.size2 = std::max(added.size2, glm::dot(d, d));
      }
      if (is_bright_[number]) continue;
      for (const Vec3& corner : added.corners) group.box.add(corner);
      group.power += largest * added.shape().area_m2;
    }
    group.end = others_.size();
    if (group.end > group.begin) groups_.push_back(group);
  }
}

/// The irradiance (largest band) that each polygon would give at p if nothing hid it.
std::vector<double> EmitterSampler::unoccluded(std::span<const Emitter> polygons, const Vec3& p,
                                               const Vec3& n, std::uint32_t own) {
  std::vector<double> weight(polygons.size(), 0.0);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const Emitter& b = polygons[i];
    const PolygonFrame& frame = b.frame();
    const Vec3 d = frame.origin - p;  // from the polygon's centroid
    const double sent = -glm::dot(frame.n, d), r2 = glm::dot(d, d);
    if (b.polygon == own || sent <= 0.0) continue;
    const double m2 = b.shape().area_m2, received = glm::dot(n, d);
    // Far away the kernel to the middle will do; near the horizon a part may still be above it.
    const bool is_far = r2 > far_areas * b.size2;
    if (is_far && received < -std::sqrt(b.size2)) continue;
    weight[i] = b.largest_radiosity * (is_far && received > std::sqrt(b.size2)
                                           ? m2 * received * sent / (std::numbers::pi * r2 * r2)
                                           : point_to_polygon(p, n, b.corners));
  }
  return weight;
}

const EmitterSampler::ControlledPolygon* EmitterSampler::ControlVariate::find(
    std::uint32_t polygon) const {
  const auto at = std::lower_bound(polygons.begin(), polygons.end(), polygon,
                                   [](const ControlledPolygon& controlled, std::uint32_t number) {
                                     return controlled.polygon < number;
                                   });
  return at != polygons.end() && at->polygon == polygon ? &*at : nullptr;
}

EmitterSampler::Survey EmitterSampler::survey(const Vec3& p, const Vec3& n, std::uint32_t own,
                                              int rays, Random& random) const {
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(rays))));
  Survey survey;
  survey.rays = side * side;
  std::vector<std::pair<std::uint32_t, Vec3>> ends;
  for (int i = 0; i < survey.rays; ++i) {
    const double r2 = (i / side + random.uniform()) / side;
    const double turn = (i % side + random.uniform()) / side;
    const Vec3 direction = cosine_direction(n, r2, turn);
    const RayHit hit = occluders_->rays().closest(p, direction, own, 1e30, RayStart::in_air);
    if (hit.any() && hit.front && !is_bright_[hit.polygon])
      ends.emplace_back(hit.polygon, p + hit.distance_m * direction);
  }
  std::stable_sort(ends.begin(), ends.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  Spectrum radiosity;
  for (const auto& [polygon, at] : ends) {
    const PolygonRef ref = occluders_->local(polygon);
    const PatchForest& patches = clusters_[ref.cluster.index()].patches();
    radiosity.assign(static_cast<std::size_t>(patches.bands()), 0.0);
    patches.evaluate(true, ref.polygon, at, radiosity);
    if (survey.seen.empty() || survey.seen.back().polygon != polygon)
      survey.seen.push_back({polygon, 0, Spectrum(radiosity.size(), 0.0)});
    Survey::Seen& seen = survey.seen.back();
    ++seen.rays;
    for (std::size_t b = 0; b < radiosity.size(); ++b) seen.radiosity[b] += radiosity[b];
    const double largest = *std::max_element(radiosity.begin(), radiosity.end());
    seen.square += largest * largest;
  }
  return survey;
}

Spectrum EmitterSampler::Survey::mean(const ControlVariate& control, std::size_t bands) const {
  Spectrum sum(bands, 0.0);
  int ends = 0;
  for (const Seen& polygon : seen) {
    if (control.find(polygon.polygon) != nullptr) continue;
    ends += polygon.rays;
    for (std::size_t b = 0; b < bands; ++b) sum[b] += polygon.radiosity[b];
  }
  for (double& s : sum) s = ends > 0 ? s / ends : 0.0;
  return sum;
}

/// Of all bright emitters; returns what they would give if nothing hid them. `known`: irradiance
/// (largest band) that comes from elsewhere.
double EmitterSampler::control_bright(const Vec3& p, const Vec3& n, std::uint32_t own, double known,
                                      double least, Random& random, ControlVariate& control,
                                      Spectrum& variance) const {
  const std::vector<double> weight = unoccluded(bright_, p, n, own);
  const double total = std::accumulate(weight.begin(), weight.end(), 0.0);
  double seen = std::max(known, least_seen * total);
  VisibleNodes visible(*occluders_);
  ControlledPolygon next;
  for (std::size_t i = 0; i < bright_.size(); ++i) {
    if (weight[i] <= negligible_emitter * total || weight[i] <= 0.0) continue;
    const Emitter& b = bright_[i];
    const ClusterId cluster = occluders_->local(b.polygon).cluster;
    next.polygon = b.polygon;
    if (!visible.find(p, n, own, cluster, *b.forest, b.node, least * seen, next.nodes)) {
      next.nodes.resize(1);
      const double variance_of_factor = visible.find_by_parts(
          p, n, own, cluster, *b.forest, b.node, least * seen,
          smallest_part * total / b.largest_radiosity, random, next.nodes.front());
      for (std::size_t band = 0; band < variance.size(); ++band)
        variance[band] += variance_of_factor * b.radiosity(band) * b.radiosity(band);
    }
    for (const VisibleNode& node : next.nodes) seen += node.factor * b.largest_radiosity;
    if (!next.nodes.empty()) control.polygons.push_back(next);
  }
  return total;
}

/// Of the polygons seen, those that make rays noisy, until all others together would give
/// `most_square` at most: the mean square of a ray's deviation from the mean. Noisiest first.
std::vector<std::uint32_t> EmitterSampler::noisy_polygons(const Survey& survey, double mean,
                                                          double most_square) const {
  std::vector<std::pair<double, std::uint32_t>> noisy;
  double left = 0.0;
  for (const Survey::Seen& polygon : survey.seen) {
    const double sum = *std::max_element(polygon.radiosity.begin(), polygon.radiosity.end());
    // A few rays may miss the brightest part.
    const PolygonRef ref = occluders_->local(polygon.polygon);
    const double deviation = clusters_[ref.cluster.index()].patches().deviation(ref.polygon);
    const double square = std::max(polygon.square - 2.0 * mean * sum + polygon.rays * mean * mean,
                                   polygon.rays * deviation * deviation) /
                          survey.rays;
    left += square;
    noisy.emplace_back(square, polygon.polygon);
  }
  std::stable_sort(noisy.begin(), noisy.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::uint32_t> polygons;
  for (const auto& [square, polygon] : noisy) {
    if (left <= most_square || polygons.size() >= most_controlled) break;
    polygons.push_back(polygon);
    left -= square;
  }
  return polygons;
}

/// Adds the polygons that would give more than `least_share` of all light if nothing hid any, of
/// which `bright` comes from the bright emitters. No polygon gives more than its cluster's power
/// over pi and the squared distance of the cluster's box: those that are far away for their power
/// are not looked into.
void EmitterSampler::add_large_others(const Vec3& p, const Vec3& n, std::uint32_t own,
                                      double bright, double least_share,
                                      std::vector<std::uint32_t>& polygons) const {
  std::vector<std::pair<double, const OtherGroup*>> groups;
  for (const OtherGroup& group : groups_) {
    const double r_m = gap_m(group.box, {p, p});
    groups.emplace_back(group.power / (std::numbers::pi * r_m * r_m), &group);
  }
  std::sort(groups.begin(), groups.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  double total = bright;
  std::vector<std::pair<double, std::uint32_t>> found;
  for (const auto& [most, group] : groups) {
    if (most <= least_share * total) break;
    const auto of_group = std::span(others_).subspan(group->begin, group->end - group->begin);
    const std::vector<double> weight = unoccluded(of_group, p, n, own);
    for (std::size_t i = 0; i < weight.size(); ++i) {
      total += weight[i];
      if (weight[i] > 0.0) found.emplace_back(weight[i], of_group[i].polygon);
    }
  }
  for (const auto& [weight, polygon] : found) {
    if (weight > least_share * total) polygons.push_back(polygon);
  }
}

/// Of the polygons that are not bright: by the survey, and by what they would give if nothing hid
/// them, since the survey may miss one that is seen at a low angle. `bright`: of the bright
/// emitters.
void EmitterSampler::control_others(const Vec3& p, const Vec3& n, std::uint32_t own,
                                    const Survey& survey, double most_square, double bright,
                                    double least_share, double least,
                                    ControlVariate& control) const {
  const Spectrum means = survey.mean(control, control.ambient.size());
  const double mean = means.empty() ? 0.0 : *std::max_element(means.begin(), means.end());
  std::vector<std::uint32_t> polygons = noisy_polygons(survey, mean, most_square);
  add_large_others(p, n, own, bright, least_share, polygons);
  std::sort(polygons.begin(), polygons.end());
  polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
  VisibleNodes visible(*occluders_);
  ControlledPolygon next;
  for (const std::uint32_t polygon : polygons) {
    const PolygonRef ref = occluders_->local(polygon);
    next.polygon = polygon;
    if (visible.find_some(p, n, own, ref.cluster, clusters_[ref.cluster.index()].patches(),
                          ref.polygon, least, mean, next.nodes))
      control.polygons.push_back(next);
  }
}

EmitterSampler::ControlVariate EmitterSampler::add_control_variate(
    const Vec3& p, const Vec3& n, std::uint32_t own, const Survey& survey, int rays, double least,
    Random& random, Spectrum& irradiance, Spectrum& variance) const {
  ControlVariate control;
  double known = *std::max_element(irradiance.begin(), irradiance.end());
  for (const Survey::Seen& polygon : survey.seen)
    known += *std::max_element(polygon.radiosity.begin(), polygon.radiosity.end()) / survey.rays;
  const double bright = control_bright(p, n, own, known, least, random, control, variance);
  for (const ControlledPolygon& polygon : control.polygons) {
    const PatchForest& forest =
        clusters_[occluders_->local(polygon.polygon).cluster.index()].patches();
    for (const VisibleNode& node : polygon.nodes) known += node.irradiance(forest, 0);
  }
  const double noise = rays_share * least * known;
  control.ambient.assign(irradiance.size(), 0.0);
  control_others(p, n, own, survey, noise * noise * rays, bright, least, least * known, control);
  std::sort(
      control.polygons.begin(), control.polygons.end(),
      [](const ControlledPolygon& a, const ControlledPolygon& b) { return a.polygon < b.polygon; });
  control.ambient = survey.mean(control, irradiance.size());
  for (std::size_t band = 0; band < irradiance.size(); ++band) {
    irradiance[band] += control.ambient[band];
  }
  for (const ControlledPolygon& polygon : control.polygons) {
    const PatchForest& forest =
        clusters_[occluders_->local(polygon.polygon).cluster.index()].patches();
    for (const VisibleNode& node : polygon.nodes) {
      for (std::size_t band = 0; band < irradiance.size(); ++band) {
        irradiance[band] +=
            node.irradiance(forest, band) - node.factor_in(band) * control.ambient[band];
      }
    }
  }
  return control;
}

void EmitterSampler::add_emitted(const ControlVariate& control, Spectrum& irradiance) const {
  for (const ControlledPolygon& polygon : control.polygons) {
    const PolygonRef ref = occluders_->local(polygon.polygon);
    const PolygonFrame& frame = clusters_[ref.cluster.index()].patches().frames()[ref.polygon];
    for (std::size_t band = 0; band < irradiance.size(); ++band) {
      double factor = 0.0;
      for (const VisibleNode& node : polygon.nodes) factor += node.factor_in(band);
      irradiance[band] += factor * frame.exitance[band];
    }
  }
}

}  // namespace enfilade
