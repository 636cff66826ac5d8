#include "occluders/unreachable_polygons.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

constexpr int most_sweeps = 64;
/// A candidate that random walks found dark needs so many times fewer rays than another: 32 walks
/// have begun with as many rays already.
constexpr int fewer_where_walked = 4;
/// Of the share of the mean irradiance below which a polygon is a candidate, with a sky.
constexpr double sky_share = 1e-3;
/// Of the irradiance of all polygons, in one sweep: far below what decides.
constexpr double converged_change = 1e-3;

double largest(const Spectrum& bands) {
  return bands.empty() ? 0.0 : *std::max_element(bands.begin(), bands.end());
}

/// The radiosity equation with one value per polygon, form factors by rays, and the largest band
/// alone.
class RoughSolution {
 public:
  RoughSolution(const Scene& scene, std::span<const Cluster> clusters, const Occluders& occluders,
                WorkCount& work)
      : lights_(scene.lights), occluders_(occluders), work_(work) {
    for (const Cluster& c : clusters) {
      for (const ClusterPolygon& p : c.polygons) {
        const Surface& surface = scene.surfaces[p.surface.index()];
        nodes_.push_back({&p.polygon, normal(p.polygon), centroid(p.polygon), area_m2(p.polygon),
                          largest(surface.reflectance), largest(surface.exitance), p.walked_dark});
      }
    }
    for (std::uint32_t k = 0; k < nodes_.size(); ++k) {
      if (nodes_[k].exitance > 0.0) emitters_.push_back(k);
    }
    direct_.assign(nodes_.size(), 0.0);
    row_.resize(nodes_.size());
    rays_.assign(nodes_.size(), 0);
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  void emit(int rays);
  void sample_row(std::uint32_t polygon, int rays);
  void solve();
  /// Emits nothing, and its irradiance is at most `share` of the mean.
  bool nearly_unlit(std::uint32_t polygon, double share) const {
    return nodes_[polygon].exitance <= 0.0 && irradiance_[polygon] <= share * mean_;
  }
  bool sees_an_emitter(std::uint32_t polygon) const;
  bool walked_dark(std::uint32_t polygon) const { return nodes_[polygon].walked_dark; }

 private:
  struct Node {
    const Polygon* polygon;
    Vec3 n, center;
    double area_m2, reflectance, exitance;
    bool walked_dark;
  };
  RayHit cast(std::uint32_t polygon, double r2, Random& random) const;

  std::span<const LightSource> lights_;
  const Occluders& occluders_;
  WorkCount& work_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> emitters_;  ///< emitting nodes
  std::vector<double> direct_, irradiance_;
  /// Per polygon: the polygons on whose front sides its rays ended, once a ray.
  std::vector<std::vector<std::uint32_t>> row_;
  std::vector<int> rays_;  ///< per polygon, cast so far
  double mean_ = 0.0;      ///< irradiance, by area
};

/// A ray from a uniformly random point of the polygon in a cosine-distributed direction.
RayHit RoughSolution::cast(std::uint32_t polygon, double r2, Random& random) const {
  const Node& node = nodes_[polygon];
  // A ray that starts on the rim would pass behind a polygon that meets it there.
  const double inside = 1.0 - std::clamp(8.0 * occluders_.rays().epsilon_m() /
                                             std::sqrt(std::max(node.area_m2, 1e-30)),
                                         1e-3, 0.5);
  const Vec3 any = random_point(*node.polygon, random);
  ++work_.rays;
  return occluders_.rays().closest(node.center + inside * (any - node.center),
                                   cosine_direction(node.n, r2, random.uniform()), polygon);
}

/// Direct irradiance: rays from every emitting polygon and every point light.
void RoughSolution::emit(int rays) {
  const auto arrive = [this](const RayHit& hit, double power) {
    if (hit.any() && hit.front) direct_[hit.polygon] += power / nodes_[hit.polygon].area_m2;
  };
  for (const std::uint32_t k : emitters_) {
    Random random(std::uint64_t{k} << 32);
    const double power = nodes_[k].area_m2 * nodes_[k].exitance / rays;
    for (int i = 0; i < rays; ++i) arrive(cast(k, (i + random.uniform()) / rays, random), power);
  }
  for (const LightSource& light : lights_) {
    Random random(size());
    const double power = power_per_intensity(light) * largest(light.intensity) / rays;
    for (int i = 0; i < rays; ++i) {
      const double r1 = (i + random.uniform()) / rays, r2 = random.uniform();
      const double r3 = light.opening.empty() ? 0.0 : random.uniform();
      const double r4 = light.opening.empty() ? 0.0 : random.uniform();
      const LightRay ray = emitted_ray(light, r1, r2, r3, r4);
      ++work_.rays;
      arrive(occluders_.rays().closest(ray.from, ray.direction), power * ray.weight);
    }
  }
}

/// Casts rays that estimate the polygon's row of form factors.
void RoughSolution::sample_row(std::uint32_t polygon, int rays) {
  Random random((std::uint64_t{polygon} << 32) + static_cast<std::uint64_t>(rays));
  for (int i = 0; i < rays; ++i) {
    const RayHit hit = cast(polygon, (i + random.uniform()) / rays, random);
    if (hit.any() && hit.front) row_[polygon].push_back(hit.polygon);
  }
  rays_[polygon] += rays;
}

/// Symmetric Gauss-Seidel (sweeps up and down in turn) until the irradiance changes little.
void RoughSolution::solve() {
  irradiance_ = direct_;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double power = 0.0, area = 0.0, change = 0.0;
    for (std::uint32_t i = 0; i < size(); ++i) {
      const std::uint32_t k = sweep % 2 == 0 ? i : size() - 1 - i;
      double sum = 0.0;
      for (const std::uint32_t other : row_[k])
        sum += nodes_[other].reflectance * irradiance_[other];
      const double e = direct_[k] + (rays_[k] > 0 ? sum / rays_[k] : 0.0);
      change += nodes_[k].area_m2 * std::abs(e - irradiance_[k]);
      irradiance_[k] = e;
      power += nodes_[k].area_m2 * e;
      area += nodes_[k].area_m2;
    }
    mean_ = area > 0.0 ? power / area : 0.0;
    if (change <= converged_change * power) break;
  }
}

/// From its centroid, the middle of a light (wherever that shines) or of an emitting polygon.
bool RoughSolution::sees_an_emitter(std::uint32_t polygon) const {
  const Node& node = nodes_[polygon];
  const auto open = [&](const Vec3& y, std::uint32_t emitter) {
    ++work_.rays;
    return !occluders_.rays().occluded(node.center, y, polygon, emitter);
  };
  for (const LightSource& light : lights_) {
    if (glm::dot(node.n, light.p - node.center) > 0.0 && open(light.p, RayScene::no_polygon))
      return true;
  }
  for (const std::uint32_t k : emitters_) {
    const Node& emitter = nodes_[k];
    if (k == polygon) continue;
    const Vec3 d = emitter.center - node.center;
    if (glm::dot(node.n, d) > 0.0 && glm::dot(emitter.n, d) < 0.0 && open(emitter.center, k))
      return true;
  }
  return false;
}

}  // namespace

std::vector<char> unreachable_polygons(const Scene& scene, std::span<const Cluster> clusters,
                                       const Occluders& occluders, WorkCount& work,
                                       const UnreachablePolygonsConfig& config) {
  RoughSolution rough(scene, clusters, occluders, work);
  const std::uint32_t n = rough.size();
  // What the sky lights from outside says nothing of how dark a room may be.
  const double share = scene.sky ? sky_share * config.share : config.share;
  std::vector<char> unreachable(n, 0);
  if (n == 0) return unreachable;
  rough.emit(std::max(config.more_rays, config.least_rays / static_cast<int>(n)));
  const int rays = std::max(config.rays, config.least_rays / static_cast<int>(n));
  for (std::uint32_t k = 0; k < n; ++k) rough.sample_row(k, rays);
  rough.solve();
  std::vector<std::uint32_t> candidates;
  for (std::uint32_t k = 0; k < n; ++k) {
    if (rough.nearly_unlit(k, share)) candidates.push_back(k);
  }
  if (candidates.empty()) return unreachable;
  const int more =
      std::max(config.more_rays, config.least_rays / static_cast<int>(candidates.size()));
  for (const std::uint32_t k : candidates)
    rough.sample_row(k, rough.walked_dark(k) ? more / fewer_where_walked : more);
  rough.solve();
  for (const std::uint32_t k : candidates) {
    const bool unlit = rough.nearly_unlit(k, share) && !rough.sees_an_emitter(k);
    unreachable[k] = unlit && !occluders.panes().contains(k) ? 1 : 0;  // rays pass through panes
  }
  return unreachable;
}

}  // namespace enfilade
