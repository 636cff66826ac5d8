#include "gather/error_samples.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"
#include "occluders/light_at.hpp"
#include "occluders/receiver_importance.hpp"

namespace enfilade {
namespace {

/// Uniformly distributed over a convex shape: r1 picks the triangle of its fan; the rest of r1, and
/// r2, the place in the triangle.
Vec2 point_in(const PatchShape& shape, double r1, double r2) {
  return uniform_point({shape.vertices.data(), shape.vertices.size()}, shape.area_m2, r1, r2);
}

/// The mean value of the largest band.
double top(std::span<const double> light, std::size_t terms) {
  double most = 0.0;
  for (std::size_t i = 0; i < light.size(); i += terms) most = std::max(most, light[i]);
  return most;
}

/// Least ratio of a bright emitter's radiosity to the irradiance at a point; and the same ratio per
/// ray.
constexpr double bright_ratio = 4.0, bright_ratio_per_ray = 0.01;
/// The irradiance in that ratio is at least this share of the scene's mean.
constexpr double least_bright_irradiance = 0.05;
/// Rays to a bright emitter: so many of a point's rays times its share of the light, within limits.
constexpr double emitter_rays = 0.25;
constexpr int least_emitter_rays = 4, most_emitter_rays = 256;

void add_bands(Spectrum& sum, const Spectrum& part) {
  if (sum.size() < part.size()) sum.resize(part.size(), 0.0);
  for (std::size_t b = 0; b < part.size(); ++b) sum[b] += part[b];
}

}  // namespace

void add(ErrorSampleSums& sums, const ErrorSampleSums& part) {
  for (const auto sum : {&ErrorSampleSums::light, &ErrorSampleSums::surplus, &ErrorSampleSums::off,
                         &ErrorSampleSums::noise, &ErrorSampleSums::surplus_variance})
    add_bands(sums.*sum, part.*sum);
}

ErrorSamples::ErrorSamples(const ClusterState& receiver, const Occluders& occluders,
                           const ErrorSampleConfig& config, WorkCount& work)
    : occluders_(&occluders),
      config_(config),
      work_(&work),
      receiver_(receiver.id()),
      bands_(static_cast<std::size_t>(receiver.bands())),
      random_(0x5EED0000u + receiver.id().value),
      visible_nodes_(occluders) {
  if (config_.rays <= 0) return;
  place(receiver);
  cast_rays();
}

/// Systematic sampling: a point in a leaf wherever the running sum of the expected numbers of
/// points passes a whole number plus the cluster's random offset.
void ErrorSamples::place(const ClusterState& receiver) {
  const PatchForest& patches = receiver.patches();
  const auto terms = static_cast<std::size_t>(patches.terms());
  const ReceiverImportance importance(receiver, *occluders_, config_.importance);
  double next = random_.uniform(), sum = 0.0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const PatchNode& node = patches.node(i);
    if (!node.leaf() || patches.unreachable(node.id.root) || node.shape.area_m2 <= 0.0) continue;
    const double density =
        config_.per_area + config_.per_power * std::max(0.0, top(patches.irradiance(i), terms));
    for (sum += node.shape.area_m2 * density * importance.of(node.id); next < sum; next += 1.0) {
      const PolygonFrame& frame = patches.frames()[node.id.root];
      const double r1 = random_.uniform(), r2 = random_.uniform();
      Point point{node.id.root,
                  frame.at(point_in(node.shape, r1, r2)),
                  frame.n,
                  1.0 / density,
                  top(patches.irradiance(i), terms),
                  {},
                  {}};
      point.light.fill(Spectrum(bands_, 0.0));
      point.uncontrolled_light.resize(bands_, 0.0);
      point.ray_light.resize(bands_, 0.0);
      point.x += 2.0 * occluders_->rays().epsilon_m() * frame.n;
      points_.push_back(std::move(point));
    }
  }
}

/// Casts two sets of rays from each point, each stratified over the hemisphere.
void ErrorSamples::cast_rays() {
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(0.5 * config_.rays))));
  config_.rays = 2 * side * side;
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    const Point& point = points_[p];
    for (int half = 0; half < 2; ++half) {
      for (int stratum = 0; stratum < side * side; ++stratum) {
        const double r2 = (stratum / side + random_.uniform()) / side;
        const double turn = (stratum % side + random_.uniform()) / side;
        add_ray(p, cosine_direction(point.n, r2, turn), half);
      }
    }
  }
  std::stable_sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) {
    return a.polygon.cluster < b.polygon.cluster;
  });
}

/// Notes where the ray ends on a front side, and the fronts of the panes that it passes.
void ErrorSamples::add_ray(std::uint32_t p, const Vec3& d, int half) {
  const Point& point = points_[p];
  const std::uint32_t own = occluders_->global(receiver_, point.polygon);
  ++work_->rays;
  const RayHit hit = occluders_->rays().closest(point.x, d, own);
  std::uint32_t passage = 0;
  const auto number = [this](const Passage& passed) {
    passages_.push_back(passed);
    return static_cast<std::uint32_t>(passages_.size() - 1);
  };
  if (occluders_->panes().any()) {
    const double length_m = hit.any() ? hit.distance_m : far_away_m;
    for (const PaneMet& pane : occluders_->panes_along(point.x, d, length_m, own)) {
      const Vec3 y = point.x + pane.distance_m * d;
      if (pane.front)
        hits_.push_back({occluders_->local(pane.polygon), p, half, y, number(pane.before)});
      passage = number(pane.behind);
    }
  }
  if (!hit.any() || !hit.front) return;
  hits_.push_back({occluders_->local(hit.polygon), p, half, point.x + hit.distance_m * d, passage});
}

/// A bright emitter: one ray that meets it would bring too large a share of the point's light.
bool ErrorSamples::is_bright(const PatchForest& forest, std::size_t polygon,
                             const Point& point) const {
  return top(forest.radiosity(polygon), static_cast<std::size_t>(forest.terms())) >
         bright_radiosity(point);
}

double ErrorSamples::bright_radiosity(const Point& point) const {
  const double least =
      std::max(point.irradiance, least_bright_irradiance * config_.mean_irradiance);
  return std::max(bright_ratio, bright_ratio_per_ray * config_.rays) * least;
}

void ErrorSamples::add(const LightSource& light) {
  for (Point& point : points_) {
    const std::uint32_t own = occluders_->global(receiver_, point.polygon);
    const LightAtPoint found = light_at(light, {point.x, point.n, own}, *occluders_, work_);
    for (Spectrum& half : point.light) {
      for (std::size_t b = 0; b < bands_; ++b) half[b] += light.intensity[b] * found.band(b);
    }
  }
}

void ErrorSamples::add(const ClusterState& shooter) {
  if (points_.empty()) return;
  for (Point& point : points_) add_closed_forms(shooter, point);
  const PatchForest& forest = shooter.patches();
  const auto less = [](const Hit& hit, ClusterId id) { return hit.polygon.cluster < id; };
  std::vector<double> radiosity(bands_);
  const double share = 2.0 / config_.rays;
  for (auto hit = std::lower_bound(hits_.begin(), hits_.end(), shooter.id(), less);
       hit != hits_.end() && hit->polygon.cluster == shooter.id(); ++hit) {
    Point& point = points_[hit->point];
    const std::uint32_t k = hit->polygon.polygon;
    const VisibleNode* node = node_around(point.controlled, forest, k, hit->y);
    const bool bright = is_bright(forest, k, point);
    if (node == nullptr && bright) continue;
    forest.evaluate(true, k, hit->y, radiosity);
    const auto half = static_cast<std::size_t>(hit->half);
    const Passage& passage = passages_[hit->passage];
    if (node != nullptr) point.controlled_rays[half] += share * passage.share;
    for (std::size_t b = 0; b < bands_; ++b) {
      const double had = node != nullptr ? node->radiosity(forest, b, hit->y) : 0.0;
      const double passed = share * passage.band(b);
      point.light[half][b] += passed * (radiosity[b] - had);
      if (node == nullptr) point.uncontrolled_light[b] += passed * radiosity[b];
      if (!bright) point.ray_light[b] += passed * radiosity[b];
    }
  }
}

/// The most that a polygon would bring if nothing hid it, as a share of the point's light.
double ErrorSamples::unoccluded_share(const PatchForest& forest, std::uint32_t polygon,
                                      const Point& point) const {
  const PolygonFrame& frame = forest.frames()[polygon];
  const double most = top(forest.radiosity(polygon), static_cast<std::size_t>(forest.terms()));
  if (most <= 0.0 || glm::dot(frame.n, point.x - frame.origin) <= 0.0) return 0.0;
  ++work_->form_factors;
  return most * point_to_polygon(point.x, point.n, corners_of(frame, forest.node(polygon).shape)) /
         reference_irradiance(point);
}

/// Adds the light of all polygons that matter, in closed form where few occluders hide them, so
/// that rays only estimate the difference from the nodes' affine radiosities (a control variate);
/// bright emitters behind many occluders get rays of their own.
void ErrorSamples::add_closed_forms(const ClusterState& shooter, Point& point) {
  const PatchForest& forest = shooter.patches();
  const std::uint32_t own = occluders_->global(receiver_, point.polygon);
  std::vector<VisibleNode> nodes;
  point.controlled.clear();
  for (std::uint32_t k = 0; k < forest.polygons(); ++k) {
    const bool bright = is_bright(forest, k, point);
    if (occluders_->global(shooter.id(), k) == own ||
        unoccluded_share(forest, k, point) <= (bright ? least_bright_share : least_share)) {
      continue;
    }
    if (visible_nodes_.find(point.x, point.n, own, shooter.id(), forest, k,
                            least_share * reference_irradiance(point), nodes)) {
      point.controlled.insert(point.controlled.end(), nodes.begin(), nodes.end());
    } else if (bright) {
      add_emitter(shooter, k, point);
    }
  }
  std::sort(point.controlled.begin(), point.controlled.end(),
            [](const VisibleNode& a, const VisibleNode& b) { return a.node < b.node; });
  work_->form_factors += point.controlled.size();
  for (const VisibleNode& node : point.controlled) {
    point.controlled_factor += node.factor;
    for (Spectrum& half : point.light) {
      for (std::size_t b = 0; b < bands_; ++b) half[b] += node.irradiance(forest, b);
    }
  }
}

/// Adds the polygon's light: its form factor in closed form, times the visible share of the kernel,
/// which is estimated by more rays the more light is at stake. The rays' places follow a golden
/// ratio sequence (R1).
void ErrorSamples::add_emitter(const ClusterState& shooter, std::uint32_t polygon, Point& point) {
  const PatchForest& forest = shooter.patches();
  const PolygonFrame& frame = forest.frames()[polygon];
  const PatchShape& shape = forest.node(polygon).shape;
  const double factor =
      point_to_polygon(point.x, point.n, corners_of(frame, forest.node(polygon).shape));
  const double part = unoccluded_share(forest, polygon, point);
  const int rays = std::clamp(static_cast<int>(emitter_rays * config_.rays * part),
                              least_emitter_rays, most_emitter_rays);
  const std::uint32_t own = occluders_->global(receiver_, point.polygon);
  const std::uint32_t skip = occluders_->global(shooter.id(), polygon);
  std::vector<double> radiosity(bands_);
  for (Spectrum& half : point.light) {
    Spectrum open(bands_, 0.0);
    double all = 0.0;
    const double start = random_.uniform();
    for (int i = 0; i < rays; ++i) {
      const double r1 = (i + random_.uniform()) / rays;
      const double r2 = std::fmod(start + 0.6180339887498949 * i, 1.0);
      const Vec3 y = frame.at(point_in(shape, r1, r2));
      ++work_->kernels;
      const double kernel = point_kernel(point.x, point.n, y, frame.n);
      all += kernel;
      if (kernel <= 0.0) continue;
      ++work_->rays;
      const Passage passage = occluders_->passage(point.x, y, own, skip);
      if (passage.share <= 0.0) continue;
      forest.evaluate(true, polygon, y, radiosity);
      for (std::size_t b = 0; b < bands_; ++b) open[b] += kernel * passage.band(b) * radiosity[b];
    }
    if (all <= 0.0) continue;
    for (std::size_t b = 0; b < bands_; ++b) half[b] += factor / all * open[b];
  }
}

/// The controlled nodes fill a known part of the hemisphere (controlled_factor), and the share of
/// rays that met them differs from it by chance. So the other directions got too few or too many
/// rays: this is corrected by the mean radiosity that rays found there; with the weight of one ray,
/// as there may be none, by the mean over all rays.
double ErrorSamples::irradiance_of(const Point& point, std::size_t half, std::size_t band) const {
  const double ray = 2.0 / config_.rays;
  const double others = 2.0 - point.controlled_rays[0] - point.controlled_rays[1];
  const double mean =
      (point.uncontrolled_light[band] + 0.5 * ray * point.ray_light[band]) / (others + ray);
  return point.light[half][band] + mean * (point.controlled_rays[half] - point.controlled_factor);
}

ErrorSampleSums ErrorSamples::compare(const ClusterState& receiver) const {
  const Spectrum none(bands_, 0.0);
  ErrorSampleSums sums{none, none, none, none, none};
  std::vector<double> has(bands_);
  for (const Point& point : points_) {
    receiver.patches().evaluate(false, point.polygon, point.x, has);
    for (std::size_t b = 0; b < bands_; ++b) {
      const double first = irradiance_of(point, 0, b), second = irradiance_of(point, 1, b);
      const double mean = 0.5 * (first + second), surplus = point.area_m2 * (mean - has[b]);
      sums.light[b] += point.area_m2 * mean;
      sums.surplus[b] += surplus;
      sums.surplus_variance[b] += surplus * surplus;
      sums.off[b] += point.area_m2 * std::abs(mean - has[b]);
      sums.noise[b] += point.area_m2 * 0.5 * std::abs(first - second);
    }
  }
  return sums;
}

}  // namespace enfilade
