#include "radiosity/point_gather.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "radiosity/form_factor.hpp"

namespace enfilade {
namespace {

/// Two axes that stand on n.
std::pair<Vec3, Vec3> axes_of(const Vec3& n) {
  const Vec3 helper = std::abs(n.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(helper, n));
  return {u, glm::cross(n, u)};
}

}  // namespace

/// A polygon so bright that a hemisphere of rays would find it too seldom: gathered on its own.
struct BrightPolygon {
  std::uint32_t polygon;  // global number
  const PatchForest* forest;
  std::uint32_t k;
};

struct PointGather::Impl {
  std::span<const ClusterState> clusters;
  std::span<const PointLight> lights;
  const Occluders* occluders;
  PointGatherConfig config;
  std::vector<BrightPolygon> bright;
  std::vector<bool> is_bright;
  int bands = 1;

  void choose_bright();
  void add_bright(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                  Spectrum& e) const;
  void add_lights(const Vec3& p, const Vec3& n, std::uint32_t own, Spectrum& e) const;
  void add_hemisphere(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                      Spectrum& e) const;
  double visible_factor(const Vec3& p, const Vec3& n, std::uint32_t own, const BrightPolygon& b,
                        const PatchShape& shape, double threshold, int depth, Random& random) const;
  std::uint32_t surface_at(const Vec3& p, const Vec3& n) const;
};

/// Bright: its mean radiosity is over 8 times the mean of all surfaces (so none in a furnace).
void PointGather::Impl::choose_bright() {
  double area = 0.0, power = 0.0;
  auto top = [&](const PatchForest& f, std::size_t k) {
    double b = 0.0;
    const auto terms = static_cast<std::size_t>(f.terms());
    for (std::size_t i = 0; i < f.radiosity(k).size(); i += terms)
      b = std::max(b, f.radiosity(k)[i]);
    return b;
  };
  std::size_t polygons = 0;
  for (const ClusterState& c : clusters) {
    const PatchForest& f = c.patches();
    polygons += f.polygons();
    for (std::size_t k = 0; k < f.polygons(); ++k) {
      area += f.node(k).shape.area_m2;
      power += f.node(k).shape.area_m2 * top(f, k);
    }
  }
  is_bright.assign(polygons, false);
  const double limit = area > 0.0 ? 8.0 * power / area : 0.0;
  for (const ClusterState& c : clusters) {
    const PatchForest& f = c.patches();
    for (std::uint32_t k = 0; k < f.polygons(); ++k) {
      if (top(f, k) <= limit || limit <= 0.0) continue;
      const std::uint32_t number = occluders->global(c.id(), k);
      is_bright[number] = true;
      bright.push_back({number, &f, k});
    }
  }
}

/// Form factor times visibility of a part of a bright polygon; partly hidden parts are cut in two
/// until they matter less than the threshold.
double PointGather::Impl::visible_factor(const Vec3& p, const Vec3& n, std::uint32_t own,
                                         const BrightPolygon& b, const PatchShape& shape,
                                         double threshold, int depth, Random& random) const {
  const PolygonFrame& frame = b.forest->frames()[b.k];
  Polygon corners;
  for (const Vec2& c : shape.vertices) corners.push_back(frame.at(c));
  const double factor = point_to_polygon(p, n, corners);
  if (factor <= 0.0) return 0.0;
  int open = 0, rays = 0;
  auto look = [&](const Vec2& at) {
    ++rays;
    open += occluders->rays().occluded(p, frame.at(at), own, b.polygon) ? 0 : 1;
  };
  for (const Vec2& q : shape.quadrature()) look(q);
  if (factor > threshold) {
    for (const Vec2& c : shape.vertices) look(shape.centroid + 0.98 * (c - shape.centroid));
  }
  if (open == rays) return factor;
  if (open == 0 && (factor <= 8.0 * threshold || depth >= 3)) return 0.0;
  if (factor <= threshold || depth >= 16) return factor * open / rays;
  auto [low, high] = shape.bisect();
  return visible_factor(p, n, own, b, low, threshold, depth + 1, random) +
         visible_factor(p, n, own, b, high, threshold, depth + 1, random);
}

void PointGather::Impl::add_bright(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                                   Spectrum& e) const {
  // A hidden part smaller than a thousandth of all that is bright here does not matter.
  double total = 0.0;
  std::vector<double> weight(bright.size(), 0.0);
  Polygon corners;
  for (std::size_t i = 0; i < bright.size(); ++i) {
    const BrightPolygon& b = bright[i];
    const PolygonFrame& frame = b.forest->frames()[b.k];
    if (b.polygon == own || glm::dot(frame.n, p - frame.origin) <= 0.0) continue;
    corners.clear();
    for (const Vec2& c : b.forest->node(b.k).shape.vertices) corners.push_back(frame.at(c));
    weight[i] = point_to_polygon(p, n, corners) * b.forest->radiosity(b.k)[0];
    total += weight[i];
  }
  const auto terms = static_cast<std::size_t>(bright.empty() ? 1 : bright[0].forest->terms());
  for (std::size_t i = 0; i < bright.size(); ++i) {
    if (weight[i] <= 1e-6 * total || weight[i] <= 0.0) continue;
    const BrightPolygon& b = bright[i];
    const double light = b.forest->radiosity(b.k)[0];
    const double factor =
        visible_factor(p, n, own, b, b.forest->node(b.k).shape, 5e-4 * total / light, 0, random);
    for (std::size_t band = 0; band < e.size(); ++band) {
      e[band] += factor * b.forest->radiosity(b.k)[band * terms];
    }
  }
}

void PointGather::Impl::add_lights(const Vec3& p, const Vec3& n, std::uint32_t own,
                                   Spectrum& e) const {
  for (const PointLight& light : lights) {
    const Vec3 d = light.p - p;
    const double r2 = glm::dot(d, d), cosine = glm::dot(d, n);
    if (cosine <= 0.0 || occluders->rays().occluded(p, light.p, own)) continue;
    for (std::size_t band = 0; band < e.size(); ++band) {
      e[band] += light.intensity[band] * cosine / (r2 * std::sqrt(r2));
    }
  }
}

/// Everything else: cosine-weighted rays, one in each stratum of the disc below the hemisphere
/// (Nusselt).
void PointGather::Impl::add_hemisphere(const Vec3& p, const Vec3& n, std::uint32_t own,
                                       Random& random, Spectrum& e) const {
  const auto [u, v] = axes_of(n);
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(config.rays))));
  Spectrum sum(e.size(), 0.0);
  std::vector<double> b(e.size());
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double r = std::sqrt((i + random.uniform()) / side);
      const double phi = 2.0 * std::numbers::pi * (j + random.uniform()) / side;
      const double z = std::sqrt(std::max(0.0, 1.0 - r * r));
      const Vec3 d = r * std::cos(phi) * u + r * std::sin(phi) * v + z * n;
      const RayHit hit = occluders->rays().closest(p, d, own);
      if (!hit.any() || !hit.front || is_bright[hit.polygon]) continue;
      const PolygonRef ref = occluders->local(hit.polygon);
      clusters[ref.cluster.index()].patches().evaluate(true, ref.polygon, p + hit.distance_m * d,
                                                       b);
      for (std::size_t band = 0; band < e.size(); ++band) sum[band] += b[band];
    }
  }
  for (std::size_t band = 0; band < e.size(); ++band) e[band] += sum[band] / (side * side);
}

/// The polygon that p lies on with the same facing, within the rays' blind distance; else none.
std::uint32_t PointGather::Impl::surface_at(const Vec3& p, const Vec3& n) const {
  const double reach = 4.0 * occluders->rays().epsilon_m();
  const RayHit hit =
      occluders->rays().closest(p + reach * n, -n, RayScene::no_polygon, 2.0 * reach);
  return hit.any() && hit.front ? hit.polygon : RayScene::no_polygon;
}

PointGather::PointGather(std::span<const ClusterState> clusters, std::span<const PointLight> lights,
                         const Occluders& occluders, const PointGatherConfig& config)
    : impl_(std::make_unique<Impl>()) {
  impl_->clusters = clusters;
  impl_->lights = lights;
  impl_->occluders = &occluders;
  impl_->config = config;
  if (!clusters.empty()) impl_->bands = clusters[0].bands();
  impl_->choose_bright();
}

PointGather::~PointGather() = default;

Spectrum PointGather::irradiance(const Vec3& p, const Vec3& n) const {
  // The same point gives the same answer, whichever points were asked before it.
  Random random(impl_->config.seed);
  Spectrum e(static_cast<std::size_t>(impl_->bands), 0.0);
  const std::uint32_t own = impl_->surface_at(p, n);
  // Off the surface, so that a corner's other walls stay on their side.
  const Vec3 x = p + 2.0 * impl_->occluders->rays().epsilon_m() * n;
  impl_->add_bright(x, n, own, random, e);
  impl_->add_lights(x, n, own, e);
  impl_->add_hemisphere(x, n, own, random, e);
  return e;
}

Spectrum PointGather::from_patches(const Vec3& p, const Vec3& n) const {
  Spectrum e(static_cast<std::size_t>(impl_->bands), 0.0);
  std::uint32_t polygon = impl_->surface_at(p, n);
  if (polygon == RayScene::no_polygon) {
    const RayHit hit = impl_->occluders->rays().closest(p, -n);
    if (!hit.any() || !hit.front) return e;
    polygon = hit.polygon;
  }
  const PolygonRef ref = impl_->occluders->local(polygon);
  impl_->clusters[ref.cluster.index()].patches().evaluate(false, ref.polygon, p, e);
  return e;
}

Spectrum PointGather::radiosity(std::uint32_t polygon, const Vec3& p) const {
  Spectrum b(static_cast<std::size_t>(impl_->bands), 0.0);
  const PolygonRef ref = impl_->occluders->local(polygon);
  impl_->clusters[ref.cluster.index()].patches().evaluate(true, ref.polygon, p, b);
  return b;
}

}  // namespace enfilade
