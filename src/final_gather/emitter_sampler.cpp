#include "final_gather/emitter_sampler.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

double top_radiosity(const PatchForest& f, std::size_t k) {
  const auto terms = static_cast<std::size_t>(f.terms());
  double top = 0.0;
  for (std::size_t i = 0; i < f.radiosity(k).size(); i += terms) {
    top = std::max(top, f.radiosity(k)[i]);
  }
  return top;
}

Polygon corners_of(const PatchForest& f, std::size_t k, const PatchShape& shape) {
  Polygon corners;
  for (const Vec2& c : shape.vertices) corners.push_back(f.frames()[k].at(c));
  return corners;
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
      power += f.node(k).shape.area_m2 * top_radiosity(f, k);
    }
  }
  is_bright_.assign(polygons, false);
  const double limit = area > 0.0 ? 8.0 * power / area : 0.0;
  for (const ClusterState& c : clusters) {
    const PatchForest& f = c.patches();
    for (std::uint32_t k = 0; k < f.polygons(); ++k) {
      const double top = top_radiosity(f, k);
      if (top <= 0.0) continue;
      const std::uint32_t number = occluders.global(c.id(), k);
      is_bright_[number] = top > limit;
      (top > limit ? bright_ : others_)
          .push_back({number, &f, k, corners_of(f, k, f.node(k).shape), top});
    }
  }
}

/// Adds a part of a bright polygon as far as it is visible; partly hidden parts are cut in two
/// until they matter less than the threshold.
void EmitterSampler::add_visible(const Vec3& p, const Vec3& n, std::uint32_t own, const Bright& b,
                                 const PatchShape& shape, double threshold, int depth,
                                 VisibleNode& sum) const {
  const PolygonFrame& frame = b.forest->frames()[b.k];
  const double factor = point_to_polygon(p, n, corners_of(*b.forest, b.k, shape));
  if (factor <= 0.0) return;
  int open = 0, rays = 0;
  auto look = [&](const Vec2& at) {
    ++rays;
    open += occluders_->rays().occluded(p, frame.at(at), own, b.polygon, RayStart::in_air) ? 0 : 1;
  };
  for (const Vec2& q : shape.quadrature()) look(q);
  if (factor > threshold) {
    for (const Vec2& c : shape.vertices) look(shape.centroid + 0.98 * (c - shape.centroid));
  }
  if (open == 0 && (factor <= 8.0 * threshold || depth >= 3)) return;
  if (open == rays || factor <= threshold || depth >= 16) {
    sum.add(factor * open / rays, shape.centroid - b.forest->node(b.k).shape.centroid);
    return;
  }
  auto [low, high] = shape.halves(shape.cut({}));
  add_visible(p, n, own, b, low, threshold, depth + 1, sum);
  add_visible(p, n, own, b, high, threshold, depth + 1, sum);
}

/// What each would give at p if nothing hid it.
std::vector<double> EmitterSampler::weights(const std::vector<Bright>& polygons, const Vec3& p,
                                            const Vec3& n, std::uint32_t own) {
  std::vector<double> weight(polygons.size(), 0.0);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const Bright& b = polygons[i];
    const PolygonFrame& frame = b.forest->frames()[b.k];
    if (b.polygon == own || glm::dot(frame.n, p - frame.origin) <= 0.0) continue;
    weight[i] = point_to_polygon(p, n, b.corners) * b.top;
  }
  return weight;
}

/// Mean radiosity of the others that were not counted, by what each would give if nothing hid it.
Spectrum EmitterSampler::ambient(std::span<const double> weights, const ControlVariate& counted,
                                 std::size_t bands) const {
  Spectrum sum(bands, 0.0);
  double factors = 0.0;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const Bright& b = others_[i];
    if (weights[i] <= 0.0 || counted.find(b.polygon) != nullptr) continue;
    const double factor = weights[i] / b.top;
    factors += factor;
    for (std::size_t band = 0; band < bands; ++band) sum[band] += factor * b.radiosity(band);
  }
  for (double& s : sum) s = factors > 0.0 ? s / factors : 0.0;
  return sum;
}

const EmitterSampler::ControlledPolygon* EmitterSampler::ControlVariate::find(
    std::uint32_t polygon) const {
  const auto at = std::lower_bound(polygons.begin(), polygons.end(), polygon,
                                   [](const ControlledPolygon& counted, std::uint32_t number) {
                                     return counted.polygon < number;
                                   });
  return at != polygons.end() && at->polygon == polygon ? &*at : nullptr;
}

EmitterSampler::ControlVariate EmitterSampler::add_largest(const Vec3& p, const Vec3& n,
                                                           std::uint32_t own, double least,
                                                           Spectrum& irradiance) const {
  ControlVariate counted;
  const std::vector<double> bright = weights(bright_, p, n, own);
  const std::vector<double> other = weights(others_, p, n, own);
  const double total_bright = std::accumulate(bright.begin(), bright.end(), 0.0);
  const double total = std::accumulate(other.begin(), other.end(), total_bright);
  VisibleNodes seen(*occluders_);
  ControlledPolygon next;
  const auto exact = [&](const Bright& b) {
    next.polygon = b.polygon;
    return seen.look(p, n, own, occluders_->local(b.polygon).cluster, *b.forest, b.k, least * total,
                     next.nodes);
  };
  for (std::size_t i = 0; i < bright_.size(); ++i) {
    if (bright[i] <= 1e-6 * total_bright || bright[i] <= 0.0) continue;
    const Bright& b = bright_[i];
    if (!exact(b)) {
      // A hidden part smaller than a thousandth of all that is bright here does not matter.
      const double threshold = 5e-4 * total_bright / b.top;
      next.nodes = {VisibleNode{b.k}};
      add_visible(p, n, own, b, b.forest->node(b.k).shape, threshold, 0, next.nodes.front());
    }
    counted.polygons.push_back(next);
  }
  for (std::size_t i = 0; i < others_.size(); ++i) {
    if (other[i] > least * total && exact(others_[i])) counted.polygons.push_back(next);
  }
  std::sort(
      counted.polygons.begin(), counted.polygons.end(),
      [](const ControlledPolygon& a, const ControlledPolygon& b) { return a.polygon < b.polygon; });
  counted.ambient = ambient(other, counted, irradiance.size());
  for (std::size_t band = 0; band < irradiance.size(); ++band) {
    irradiance[band] += counted.ambient[band];
  }
  for (const ControlledPolygon& polygon : counted.polygons) {
    const PatchForest& forest =
        clusters_[occluders_->local(polygon.polygon).cluster.index()].patches();
    for (const VisibleNode& node : polygon.nodes) {
      for (std::size_t band = 0; band < irradiance.size(); ++band) {
        irradiance[band] += node.irradiance(forest, band) - node.factor * counted.ambient[band];
      }
    }
  }
  return counted;
}

std::vector<double> EmitterSampler::weights_near(const Vec3& p) const {
  std::vector<double> sums;
  double sum = 0.0;
  for (const Bright& b : bright_) {
    const PatchShape& shape = b.forest->node(b.k).shape;
    const Vec3 d = b.forest->frames()[b.k].at(shape.centroid) - p;
    sum += b.top * shape.area_m2 / (glm::dot(d, d) + shape.area_m2);
    sums.push_back(sum);
  }
  return sums;
}

void EmitterSampler::add_one(const Vec3& p, const Vec3& n, std::uint32_t own,
                             std::span<const double> weights, Random& random,
                             std::span<const double> share, Spectrum& irradiance) const {
  if (bright_.empty()) return;
  const double pick = random.uniform() * weights.back();
  const auto at = std::upper_bound(weights.begin(), weights.end(), pick) - weights.begin();
  const std::size_t i = std::min(static_cast<std::size_t>(at), bright_.size() - 1);
  const Bright& b = bright_[i];
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
