#include "gather/error_samples.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

Vec2 point_in(const PatchShape& shape, double r1, double r2) {
  return uniform_point({shape.vertices.data(), shape.vertices.size()}, shape.area_m2, r1, r2);
}

double top(std::span<const double> light, std::size_t terms) {
  double most = 0.0;
  for (std::size_t i = 0; i < light.size(); i += terms) most = std::max(most, light[i]);
  return most;
}

/// What may bring less than this share of a point's light is left to the rays.
constexpr double least_share = 5e-3;

Polygon corners_of(const PatchForest& forest, std::uint32_t polygon) {
  Polygon corners;
  for (const Vec2& c : forest.node(polygon).shape.vertices) {
    corners.push_back(forest.frames()[polygon].at(c));
  }
  return corners;
}

void add_bands(Spectrum& sum, const Spectrum& part) {
  if (sum.size() < part.size()) sum.resize(part.size(), 0.0);
  for (std::size_t b = 0; b < part.size(); ++b) sum[b] += part[b];
}

}  // namespace

void add(ErrorSampleSums& sums, const ErrorSampleSums& part) {
  add_bands(sums.light, part.light);
  add_bands(sums.surplus, part.surplus);
  add_bands(sums.off, part.off);
  add_bands(sums.noise, part.noise);
}

ErrorSamples::ErrorSamples(const ClusterState& receiver, const Occluders& occluders,
                           const ErrorSampleConfig& config, WorkCount& work)
    : occluders_(&occluders),
      config_(config),
      work_(&work),
      receiver_(receiver.id()),
      bands_(static_cast<std::size_t>(receiver.bands())),
      random_(0x5EED0000u + receiver.id().value),
      seen_(occluders) {
  if (config_.rays <= 0) return;
  place(receiver);
  cast_rays();
}

/// Systematic sampling along the leaves: a point wherever the running sum of expected points passes
/// a whole number plus the cluster's own offset.
void ErrorSamples::place(const ClusterState& receiver) {
  const PatchForest& patches = receiver.patches();
  const auto terms = static_cast<std::size_t>(patches.terms());
  double next = random_.uniform(), sum = 0.0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const PatchNode& node = patches.node(i);
    if (!node.leaf() || patches.unreachable(node.id.root) || node.shape.area_m2 <= 0.0) continue;
    const double density =
        config_.per_area + config_.per_power * std::max(0.0, top(patches.irradiance(i), terms));
    for (sum += node.shape.area_m2 * density; next < sum; next += 1.0) {
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
      point.left_to_rays.resize(bands_, 0.0);
      point.met_by_rays.resize(bands_, 0.0);
      point.x += 2.0 * occluders_->rays().epsilon_m() * frame.n;
      points_.push_back(std::move(point));
    }
  }
}

/// Two sets of rays, each stratified over the hemisphere.
void ErrorSamples::cast_rays() {
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(0.5 * config_.rays))));
  config_.rays = 2 * side * side;
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    const Point& point = points_[p];
    const std::uint32_t own = occluders_->global(receiver_, point.polygon);
    for (int half = 0; half < 2; ++half) {
      for (int stratum = 0; stratum < side * side; ++stratum) {
        const double r2 = (stratum / side + random_.uniform()) / side;
        const double turn = (stratum % side + random_.uniform()) / side;
        const Vec3 d = cosine_direction(point.n, r2, turn);
        ++work_->rays;
        const RayHit hit = occluders_->rays().closest(point.x, d, own);
        if (!hit.any() || !hit.front) continue;
        hits_.push_back({occluders_->local(hit.polygon), p, half, point.x + hit.distance_m * d});
      }
    }
  }
  std::stable_sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) {
    return a.polygon.cluster < b.polygon.cluster;
  });
}

/// One ray that meets it would bring too large a share of the point's light to leave it to luck.
bool ErrorSamples::is_bright(const PatchForest& forest, std::size_t polygon,
                             const Point& point) const {
  const double least = std::max(point.irradiance, 0.05 * config_.mean_irradiance);
  return top(forest.radiosity(polygon), static_cast<std::size_t>(forest.terms())) >
         std::max(4.0, 0.01 * config_.rays) * least;
}

void ErrorSamples::from(const PointLight& light) {
  for (Point& point : points_) {
    const Vec3 d = light.p - point.x;
    const double r2 = glm::dot(d, d), cosine = glm::dot(d, point.n);
    if (cosine <= 0.0) continue;
    ++work_->rays;
    const std::uint32_t own = occluders_->global(receiver_, point.polygon);
    if (occluders_->rays().occluded(point.x, light.p, own)) continue;
    for (Spectrum& half : point.light) {
      for (std::size_t b = 0; b < bands_; ++b) {
        half[b] += light.intensity[b] * cosine / (r2 * std::sqrt(r2));
      }
    }
  }
}

void ErrorSamples::from(const ClusterState& shooter) {
  if (points_.empty()) return;
  for (Point& point : points_) count_nodes(shooter, point);
  const PatchForest& forest = shooter.patches();
  const auto less = [](const Hit& hit, ClusterId id) { return hit.polygon.cluster < id; };
  std::vector<double> radiosity(bands_);
  const double share = 2.0 / config_.rays;
  for (auto hit = std::lower_bound(hits_.begin(), hits_.end(), shooter.id(), less);
       hit != hits_.end() && hit->polygon.cluster == shooter.id(); ++hit) {
    Point& point = points_[hit->point];
    const std::uint32_t k = hit->polygon.polygon;
    const VisibleNode* counted = node_around(point.counted, forest, k, hit->y);
    const bool bright = is_bright(forest, k, point);
    if (counted == nullptr && bright) continue;
    forest.evaluate(true, k, hit->y, radiosity);
    const auto half = static_cast<std::size_t>(hit->half);
    if (counted != nullptr) point.counted_rays[half] += share;
    for (std::size_t b = 0; b < bands_; ++b) {
      const double had = counted != nullptr ? counted->radiosity(forest, b, hit->y) : 0.0;
      point.light[half][b] += share * (radiosity[b] - had);
      if (counted == nullptr) point.left_to_rays[b] += share * radiosity[b];
      if (!bright) point.met_by_rays[b] += share * radiosity[b];
    }
  }
}

/// What a polygon would bring at most if nothing hid it, as a share of the point's light.
double ErrorSamples::share_of(const PatchForest& forest, std::uint32_t polygon,
                              const Point& point) const {
  const PolygonFrame& frame = forest.frames()[polygon];
  const double most = top(forest.radiosity(polygon), static_cast<std::size_t>(forest.terms()));
  if (most <= 0.0 || glm::dot(frame.n, point.x - frame.origin) <= 0.0) return 0.0;
  ++work_->form_factors;
  return most * point_to_polygon(point.x, point.n, corners_of(forest, polygon)) / light_at(point);
}

/// Closed forms of all that matters and is hidden by few, so that rays have only to find what
/// differs from the nodes' affine radiosities; of bright ones behind many, rays to them.
void ErrorSamples::count_nodes(const ClusterState& shooter, Point& point) {
  const PatchForest& forest = shooter.patches();
  const std::uint32_t own = occluders_->global(receiver_, point.polygon);
  std::vector<VisibleNode> nodes;
  point.counted.clear();
  for (std::uint32_t k = 0; k < forest.polygons(); ++k) {
    const bool bright = is_bright(forest, k, point);
    if (occluders_->global(shooter.id(), k) == own ||
        share_of(forest, k, point) <= (bright ? 1e-6 : least_share)) {
      continue;
    }
    if (seen_.look(point.x, point.n, own, shooter.id(), forest, k, least_share * light_at(point),
                   nodes)) {
      point.counted.insert(point.counted.end(), nodes.begin(), nodes.end());
    } else if (bright) {
      from_bright(shooter, k, point);
    }
  }
  std::sort(point.counted.begin(), point.counted.end(),
            [](const VisibleNode& a, const VisibleNode& b) { return a.node < b.node; });
  work_->form_factors += point.counted.size();
  for (const VisibleNode& seen : point.counted) {
    point.counted_factor += seen.factor;
    for (Spectrum& half : point.light) {
      for (std::size_t b = 0; b < bands_; ++b) half[b] += seen.irradiance(forest, b);
    }
  }
}

/// The closed form, times the share that rays find open: more of them the more it gives.
void ErrorSamples::from_bright(const ClusterState& shooter, std::uint32_t polygon, Point& point) {
  const PatchForest& forest = shooter.patches();
  const PolygonFrame& frame = forest.frames()[polygon];
  const PatchShape& shape = forest.node(polygon).shape;
  const double factor = point_to_polygon(point.x, point.n, corners_of(forest, polygon));
  const double part = share_of(forest, polygon, point);
  const int rays = std::clamp(static_cast<int>(0.25 * config_.rays * part), 4, 256);
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
      if (occluders_->rays().occluded(point.x, y, own, skip)) continue;
      forest.evaluate(true, polygon, y, radiosity);
      for (std::size_t b = 0; b < bands_; ++b) open[b] += kernel * radiosity[b];
    }
    if (all <= 0.0) continue;
    for (std::size_t b = 0; b < bands_; ++b) half[b] += factor / all * open[b];
  }
}

/// What was counted takes up a known part of the hemisphere: how many rays met the rest by luck is
/// made up for by the mean of what they brought; with one ray's weight, for there may be none, by
/// that of all.
double ErrorSamples::light_of(const Point& point, std::size_t half, std::size_t band) const {
  const double ray = 2.0 / config_.rays;
  const double others = 2.0 - point.counted_rays[0] - point.counted_rays[1];
  const double mean =
      (point.left_to_rays[band] + 0.5 * ray * point.met_by_rays[band]) / (others + ray);
  return point.light[half][band] + mean * (point.counted_rays[half] - point.counted_factor);
}

ErrorSampleSums ErrorSamples::compare(const ClusterState& receiver) const {
  const Spectrum none(bands_, 0.0);
  ErrorSampleSums sums{none, none, none, none};
  std::vector<double> has(bands_);
  for (const Point& point : points_) {
    receiver.patches().evaluate(false, point.polygon, point.x, has);
    for (std::size_t b = 0; b < bands_; ++b) {
      const double first = light_of(point, 0, b), second = light_of(point, 1, b);
      const double mean = 0.5 * (first + second);
      sums.light[b] += point.area_m2 * mean;
      sums.surplus[b] += point.area_m2 * (mean - has[b]);
      sums.off[b] += point.area_m2 * std::abs(mean - has[b]);
      sums.noise[b] += point.area_m2 * 0.5 * std::abs(first - second);
    }
  }
  return sums;
}

}  // namespace enfilade
