#include "links/far_samples/far_sample.hpp"

#include <algorithm>
#include <cmath>

#include <boost/container/small_vector.hpp>

#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

/// About the kernel from a polygon to x; never zero, since a part of it may matter.
double rough_kernel(const Vec3& x, const Vec3& n, const BuildingLight::PolygonLight& polygon) {
  constexpr double least_cosine = 0.05;
  const Vec3 d = polygon.center - x;
  const double r2 = std::max(glm::dot(d, d), 1e-12), r = std::sqrt(r2);
  const double received = std::max(least_cosine, glm::dot(n, d) / r);
  const double sent = std::max(least_cosine, -glm::dot(polygon.plane.n, d) / r);
  return received * sent / (r2 + 0.25 * polygon.area_m2);
}

/// The polygons of a cluster by what each is about to send to a point.
struct PolygonWeights {
  boost::container::small_vector<double, 64> of;
  double total = 0.0;

  PolygonWeights(std::span<const BuildingLight::PolygonLight> polygons, const Vec3& x,
                 const Vec3& n) {
    double power = 0.0, m2 = 0.0;
    for (const BuildingLight::PolygonLight& polygon : polygons) {
      power += polygon.power;
      m2 += polygon.area_m2;
    }
    const double mean = power / m2;
    for (const BuildingLight::PolygonLight& polygon : polygons) {
      const double weight = polygon.power + mean * polygon.area_m2;
      of.push_back(polygon.plane.signed_distance(x) > 0.0 ? weight * rough_kernel(x, n, polygon)
                                                          : 0.0);
      total += of.back();
    }
  }
  /// Returns a polygon's number; `pick` is uniform in [0, 1), and total is above 0.
  std::uint32_t draw(double pick) const {
    pick *= total;
    std::uint32_t k = 0;
    while (k + 1 < of.size() && pick >= of[k]) pick -= of[k++];
    return k;
  }
};

/// What a point of a polygon sends, which stands for this form factor.
FarSample sample_at(const Vec3& y, std::uint32_t global, const BuildingLight::PolygonLight& polygon,
                    double factor) {
  return {y, global, factor, factor * polygon.emitted / polygon.area_m2,
          factor * (polygon.power - polygon.emitted) / polygon.area_m2};
}

/// Shares the light between two ways to sample it (the balance heuristic: Veach and Guibas 1995): a
/// point of the node that is drawn by its light stands for this form factor, the end of a ray that
/// is drawn by its cosine for 1.
double balanced(double factor) { return factor > 0.0 ? 1.0 / (1.0 + 1.0 / factor) : 0.0; }

}  // namespace

FarSample point_of_node(const FarView& far, std::uint32_t node, const Vec3& x, const Vec3& n,
                        double pick, bool with_rays, const Occluders& occluders, Random& random) {
  double chosen = 1.0;
  const ClusterId cluster = far.pick_cluster(node, x, pick, chosen);
  const auto polygons = far.light().polygons(cluster);
  const PolygonWeights weights(polygons, x, n);
  if (weights.total <= 0.0) return {};
  const std::uint32_t k = weights.draw(pick);
  if (weights.of[k] <= 0.0) return {};
  const std::uint32_t global = occluders.global(cluster, k);
  const Vec3 y = uniform_point(occluders.polygon(global), random.uniform(), random.uniform());
  const double factor = point_kernel(x, n, y, polygons[k].plane.n) * polygons[k].area_m2 *
                        weights.total / (chosen * weights.of[k]);
  // Rays end on no pane.
  const bool shared = with_rays && !occluders.panes().contains(global);
  return sample_at(y, global, polygons[k], shared ? balanced(factor) : std::min(1.0, factor));
}

FarSample end_of_ray(const FarView& far, std::uint32_t node, const Vec3& x, const Vec3& n,
                     const Vec3& d, std::uint32_t own, const Occluders& occluders) {
  const RayHit hit = occluders.rays().closest(x, d, own);
  if (!hit.any() || !hit.front) return {};
  const PolygonRef met = occluders.local(hit.polygon);
  if (!far.contains(node, met.cluster)) return {};
  const auto polygons = far.light().polygons(met.cluster);
  const PolygonWeights weights(polygons, x, n);
  const Vec3 y = x + hit.distance_m * d;
  double share = 1.0;  // where it cannot be drawn the other way
  if (weights.total > 0.0 && weights.of[met.polygon] > 0.0) {
    const BuildingLight::PolygonLight& polygon = polygons[met.polygon];
    const double chosen = far.probability_of(node, x, met.cluster);
    share = balanced(point_kernel(x, n, y, polygon.plane.n) * polygon.area_m2 * weights.total /
                     (chosen * weights.of[met.polygon]));
  }
  return sample_at(y, hit.polygon, polygons[met.polygon], share);
}

}  // namespace enfilade
