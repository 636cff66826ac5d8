#include "occluders/sky_at.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/clip.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/visible_parts.hpp"
#include "occluders/pane_view.hpp"

namespace enfilade {
namespace {

/// Up to so many occluders are cut out of a facet exactly.
constexpr std::size_t most_occluders = 16;
/// More polygons than these are looked for anew before each half.
constexpr std::size_t most_listed = 4096;
constexpr int most_facet_halvings = 16;
/// A facet's part with a smaller form factor is not halved any further.
constexpr double least_facet_factor = 1e-6;
/// The luminance may vary by this share within a part: three points are exact for what varies as a
/// square.
constexpr double most_luminance_variation = 0.1;
/// A facet's part is not cut where its form factor times the variation of what panes pass is less
/// than this. The rule of three points, exact for what varies as a square, errs by a few hundredths
/// of that: by 1e-4 of the light under an open sky, by 1e-3 where ten facets make 1e-3 of it.
constexpr double negligible_factor = 1e-5;
constexpr double none_seen = 1e-13;

/// Cut across its longest edge.
std::pair<Polygon, Polygon> halves(const Polygon& polygon) {
  Vec3 longest(0.0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (glm::dot(edge, edge) > glm::dot(longest, longest)) longest = edge;
  }
  const Vec3 along = glm::normalize(longest);
  return split(polygon, {along, glm::dot(along, centroid(polygon))}, 0.0);
}

class SkyView {
 public:
  SkyView(const Sky& sky, const LitPlace& place, const Occluders& occluders, WorkCount* work)
      : sky_(sky), place_(place), occluders_(occluders), work_(work) {}

  /// `among`: polygons of which those before the facet are some; null where they are not known.
  void add(const Polygon& facet, const std::vector<std::uint32_t>* among, int halvings) {
    const double factor = point_to_polygon(place_.x, place_.n, facet);
    if (factor <= none_seen || hidden_by_one(facet)) return;
    std::vector<std::uint32_t> between;
    bool known = true;
    if (among == nullptr) {
      known = occluders_.find_between({place_.x}, facet, place_.own, none, most_listed, between);
    } else {
      occluders_.find_among(*among, {place_.x}, facet, place_.own, none, between);
    }
    if (known && between.size() <= most_occluders && add_visible(facet, between)) return;
    if (factor > least_facet_factor && halvings < most_facet_halvings) {
      const auto [first, second] = halves(facet);
      if (first.size() >= 3 && second.size() >= 3) {
        add(first, known ? &between : nullptr, halvings + 1);
        add(second, known ? &between : nullptr, halvings + 1);
        return;
      }
    }
    const Vec3 middle = centroid(facet);
    const Passage passage = passage_to(middle);
    const double light = factor * sky_.relative(middle - place_.x);
    sum_ += passage.share * light;
    tint_.add(light, passage);
    error_ += 0.5 * light;
  }

  double sum() const { return sum_; }
  double error() const { return error_; }
  std::vector<double> tint() const { return tint_.mean(); }

 private:
  static constexpr std::uint32_t none = RayScene::no_polygon;

  Passage passage_to(const Vec3& y) const {
    if (work_ != nullptr) ++work_->rays;
    return occluders_.passage(place_.x, y, place_.own, none, place_.start);
  }

  /// True where the rays to all corners end on one polygon, which is convex and hides all then.
  bool hidden_by_one(const Polygon& facet) {
    std::uint32_t wall = none;
    for (const Vec3& corner : facet) {
      const std::uint32_t met = met_at(corner);
      if (met == none || (wall != none && met != wall)) return false;
      wall = met;
    }
    return true;
  }

  /// Facets share their corners, so that one ray serves four.
  std::uint32_t met_at(const Vec3& corner) {
    const auto [at, is_new] = met_.try_emplace({corner.x, corner.y, corner.z}, none);
    if (!is_new) return at->second;
    if (work_ != nullptr) ++work_->rays;
    const RayHit hit = occluders_.rays().closest(place_.x, corner - place_.x, place_.own,
                                                 far_away_m, place_.start);
    if (hit.any()) at->second = hit.polygon;
    return at->second;
  }

  bool add_visible(const Polygon& facet, const std::vector<std::uint32_t>& between) {
    parts_.begin(place_.x, facet, occluders_.tolerance_m());
    for (const std::uint32_t k : between) {
      if (!parts_.hide(occluders_.polygon(k))) return false;
    }
    if (parts_.empty()) return true;
    occluders_.panes_between({place_.x}, facet, place_.own, none, panes_);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (panes_.empty()) {
        const double light = light_of(Polygon(parts_[i].begin(), parts_[i].end()), 0);
        sum_ += light;
        tint_.add(light, {});
        continue;
      }
      cut_by_panes(place_.x, place_.n, parts_[i], panes_, occluders_, dimmed_, negligible_factor);
      for (const DimmedPart& part : dimmed_) {
        const double light = light_of(part.polygon, 0);
        sum_ += part.passage.share * light;
        tint_.add(light, part.passage);
      }
    }
    return true;
  }

  /// The form factor of a part times its mean luminance, as the kernel weighs it.
  double light_of(const Polygon& part, int cuts) const {
    const double factor = point_to_polygon(place_.x, place_.n, part);
    if (factor <= none_seen) return 0.0;
    double least = 1e300, most = 0.0;
    for (const Vec3& corner : part) {
      const double luminance = sky_.relative(corner - place_.x);
      least = std::min(least, luminance);
      most = std::max(most, luminance);
    }
    if (most - least > most_luminance_variation * most && cuts < most_facet_halvings &&
        factor > least_facet_factor) {
      const auto [first, second] = halves(part);
      if (first.size() >= 3 && second.size() >= 3)
        return light_of(first, cuts + 1) + light_of(second, cuts + 1);
    }
    const Vec3 m = normal(part);
    double sum = 0.0, weights = 0.0;
    for (std::size_t i = 2; i < part.size(); ++i) {
      const Vec3 corner[3] = {part[0], part[i - 1], part[i]};
      const double area = glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
      for (int side = 0; side < 3; ++side) {
        const Vec3 y = 0.5 * (corner[side] + corner[(side + 1) % 3]);
        const double weight = area * point_kernel(place_.x, place_.n, y, m);
        weights += weight;
        sum += weight * sky_.relative(y - place_.x);
      }
    }
    return factor * (weights > 0.0 ? sum / weights : sky_.relative(centroid(part) - place_.x));
  }

  const Sky& sky_;
  const LitPlace& place_;
  const Occluders& occluders_;
  WorkCount* work_;
  double sum_ = 0.0, error_ = 0.0;
  TintSum tint_;
  std::map<std::array<double, 3>, std::uint32_t> met_;  ///< polygon that hides a corner, or none
  VisibleParts parts_;
  std::vector<std::uint32_t> panes_;
  std::vector<DimmedPart> dimmed_;
};

}  // namespace

LightAtPoint sky_at(const LightSource& light, const LitPlace& place, const Occluders& occluders,
                    WorkCount* work) {
  SkyView view(*light.sky, place, occluders, work);
  for (const Polygon& facet : light.opening) view.add(facet, nullptr, 0);
  const double scale = std::numbers::pi * light.luminance_per_intensity;
  return {scale * view.sum(), scale * view.error(), view.tint()};
}

}  // namespace enfilade
