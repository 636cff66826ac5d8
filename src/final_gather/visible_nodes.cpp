#include "final_gather/visible_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "final_gather/mean_light.hpp"
#include "geometry/form_factor.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

/// Up to so many occluders are cut out of the polygon exactly.
constexpr std::size_t most_occluders = 16;
/// Up to so many are not told apart for a node's children; find_some() looks at so many at most.
constexpr std::size_t few_occluders = 3, most_for_nodes = 256;
/// Of `least`: how much irradiance the slope of a visible part may be wrong by. No rays correct
/// this error, as they correct the deviation from the affine function.
constexpr double cut_tolerance = 1.0 / 64.0;
constexpr int most_cuts = 10;  ///< of a visible part
/// Cuts by find_by_parts() that end in any case, and rays for a part that is not cut any further.
constexpr int most_part_cuts = 24, rays_of_part = 8;
/// More polygons than these are looked for anew before each part.
constexpr std::size_t most_listed = 4096;
/// So many of the polygons on a ray to the middle of a part are tested: does one cover it all?
constexpr int most_tried = 6;
/// Share of that error below which a part is taken as a whole, without extrapolation.
constexpr double negligible_node = 1e-3;

struct Slope {
  Vec2 along{0.0};   ///< gradient of radiosity per metre, of the band where it varies most
  double rms = 0.0;  ///< RMS variation over the shape by this gradient
};

Slope slope_over(const PatchForest& forest, std::size_t node, const PatchShape& shape) {
  Slope most;
  const std::span<const double> light = forest.radiosity(node);
  const auto lead = 3 * static_cast<std::size_t>(forest.lead_bands());
  for (std::size_t i = 0; forest.terms() == 3 && i < lead; i += 3) {
    const double x = light[i + 1], y = light[i + 2];
    const double square = x * x * shape.cxx + 2.0 * x * y * shape.cxy + y * y * shape.cyy;
    if (square > most.rms * most.rms) most = {{x, y}, std::sqrt(square)};
  }
  return most;
}

}  // namespace

Polygon corners_of(const PolygonFrame& frame, const PatchShape& shape) {
  Polygon corners;
  for (const Vec2& c : shape.vertices) corners.push_back(frame.at(c));
  return corners;
}

/// What find() and find_some() ask for.
struct VisibleNodes::Whole {
  Vec3 p, n;
  std::uint32_t own, polygon;  ///< global numbers
  const PatchForest& forest;
  double least;
  std::optional<double> ambient;  ///< none: all nodes, or a failure
};

/// True where one polygon certainly hides all of `corners_` from p: of those that a ray to the
/// middle meets, nearest first. A wall hides most of a building, with all that stands around in it.
bool VisibleNodes::is_shut(const Vec3& p, std::uint32_t own, std::uint32_t polygon) const {
  const Vec3 way = centroid(corners_) - p;
  const double length_m = glm::length(way), step_m = 2.0 * occluders_->rays().epsilon_m();
  if (length_m <= step_m) return false;
  const Vec3 direction = way / length_m;
  double gone_m = 0.0;
  for (int i = 0; i < most_tried && gone_m < length_m; ++i) {
    const RayHit hit = occluders_->rays().closest(p + gone_m * direction, direction, own,
                                                  length_m - gone_m, RayStart::in_air);
    if (!hit.any() || hit.polygon == polygon) return false;
    if (occluders_->shaft_shut({p}, corners_, hit.polygon)) return true;
    gone_m += hit.distance_m + step_m;
  }
  return false;
}

bool VisibleNodes::find(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
                        const PatchForest& forest, std::uint32_t polygon, double least,
                        std::vector<VisibleNode>& found) {
  found.clear();
  corners_ = corners_of(forest.frames()[polygon], forest.node(polygon).shape);
  const Whole whole{p, n, own, occluders_->global(shooter, polygon), forest, least, {}};
  if (is_shut(p, own, whole.polygon)) return true;
  std::vector<std::uint32_t> between;
  occluders_->panes_between({p}, corners_, own, whole.polygon, panes_);
  if (!occluders_->find_between({p}, corners_, own, whole.polygon, most_occluders, between) ||
      !find_below(whole, polygon, between, found)) {
    found.clear();
    return false;
  }
  std::sort(found.begin(), found.end(),
            [](const VisibleNode& a, const VisibleNode& b) { return a.node < b.node; });
  return true;
}

bool VisibleNodes::find_some(const Vec3& p, const Vec3& n, std::uint32_t own, ClusterId shooter,
                             const PatchForest& forest, std::uint32_t polygon, double least,
                             double ambient, std::vector<VisibleNode>& found) {
  found.clear();
  corners_ = corners_of(forest.frames()[polygon], forest.node(polygon).shape);
  const Whole whole{p, n, own, occluders_->global(shooter, polygon), forest, least, ambient};
  if (is_shut(p, own, whole.polygon)) return false;
  std::vector<std::uint32_t> between;
  occluders_->panes_between({p}, corners_, own, whole.polygon, panes_);
  if (!occluders_->find_between({p}, corners_, own, whole.polygon, most_for_nodes, between))
    return false;
  find_below(whole, polygon, between, found);
  std::sort(found.begin(), found.end(),
            [](const VisibleNode& a, const VisibleNode& b) { return a.node < b.node; });
  return !found.empty();
}

/// `between`: the polygons that may hide the node or a part of it.
bool VisibleNodes::find_below(const Whole& whole, std::size_t node,
                              std::span<const std::uint32_t> between,
                              std::vector<VisibleNode>& found) {
  const PatchForest& forest = whole.forest;
  const PatchNode& at = forest.node(node);
  corners_ = corners_of(forest.frames()[at.id.root], at.shape);
  const double factor = point_to_polygon(whole.p, whole.n, corners_);
  if (factor <= 0.0) return true;
  const bool too_many = between.size() > most_occluders;
  if (too_many && is_shut(whole.p, whole.own, whole.polygon)) return true;
  double at_stake = forest.deviation(node);
  if (too_many && whole.ambient)
    at_stake = std::max(at_stake, std::abs(largest_radiosity(forest, node) - *whole.ambient));
  if (!at.leaf() && factor * at_stake > whole.least) {
    std::vector<std::uint32_t> before = {between.begin(), between.end()};
    for (int i = 0; i < 2; ++i) {
      const auto child = static_cast<std::size_t>(at.first_child + i);
      if (between.size() > few_occluders) {
        corners_ = corners_of(forest.frames()[at.id.root], forest.node(child).shape);
        occluders_->find_among(between, {whole.p}, corners_, whole.own, whole.polygon, before);
      }
      if (!find_below(whole, child, before, found)) return false;
    }
    return true;
  }
  if (too_many || !hide_all(whole.p, between)) return whole.ambient.has_value();
  VisibleNode visible{static_cast<std::uint32_t>(node)};
  TintSum tint;
  add_visible_parts(whole.p, whole.n, forest, whole.least, visible, tint);
  visible.tint = tint.mean();
  found.push_back(visible);
  return true;
}

/// Cuts the shadows of the occluders out of `corners_`, into `parts_`; false where there are too
/// many parts.
bool VisibleNodes::hide_all(const Vec3& p, std::span<const std::uint32_t> occluders) {
  parts_.begin(p, corners_, occluders_->tolerance_m());
  return std::all_of(occluders.begin(), occluders.end(), [this](std::uint32_t occluder) {
    return parts_.hide(occluders_->polygon(occluder));
  });
}

void VisibleNodes::add_visible_parts(const Vec3& p, const Vec3& n, const PatchForest& forest,
                                     double least, VisibleNode& sum, TintSum& tint) {
  const PolygonFrame& frame = forest.frames()[forest.node(sum.node).id.root];
  const auto add = [&](std::span<const Vec3> part, const Passage* passage) {
    PatchOutline outline;
    for (const Vec3& corner : part) outline.push_back(frame.project(corner));
    VisibleNode seen{sum.node};
    add_part(p, n, forest, PatchShape::from(outline), cut_tolerance * least, most_cuts,
             passage == nullptr ? sum : seen);
    if (passage == nullptr) return;
    tint.add(seen.factor, *passage);
    sum.factor += passage->share * seen.factor;
    sum.moment += passage->share * seen.moment;
  };
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (panes_.empty()) {
      add(parts_[i], nullptr);
      continue;
    }
    cut_by_panes(p, n, parts_[i], panes_, *occluders_, dimmed_);
    for (const DimmedPart& part : dimmed_) add(part.polygon, &part.passage);
  }
}

struct VisibleNodes::ByParts {
  Vec3 p, n;
  std::uint32_t own, polygon;  ///< global numbers
  const PatchForest& forest;
  double least, least_factor;
  Random& random;
  VisibleNode& sum;
  TintSum tint{};
  double variance = 0.0;

  const PolygonFrame& frame() const { return forest.frames()[forest.node(sum.node).id.root]; }
  /// Adds the share of a part's factor that random rays find open. The variance is that of a share
  /// by Jeffreys' estimate: it is not zero where all rays end alike.
  void sample(const PatchShape& shape, double factor, const Occluders& occluders);
};

void VisibleNodes::ByParts::sample(const PatchShape& shape, double factor,
                                   const Occluders& occluders) {
  int open = 0;
  double passing = 0.0;
  for (int k = 0; k < rays_of_part; ++k) {
    const double r1 = (k + random.uniform()) / rays_of_part, r2 = random.uniform();
    const Vec2 at =
        uniform_point({shape.vertices.data(), shape.vertices.size()}, shape.area_m2, r1, r2);
    const Passage passage = occluders.passage(p, frame().at(at), own, polygon, RayStart::in_air);
    tint.add(factor / rays_of_part, passage);
    open += passage.share > 0.0 ? 1 : 0;
    passing += passage.share;
  }
  const double share = (open + 0.5) / (rays_of_part + 1.0);
  variance += factor * factor * share * (1.0 - share) / rays_of_part;
  sum.add(factor * passing / rays_of_part, shape.centroid - forest.node(sum.node).shape.centroid);
}

/// `among`: polygons of which those before the part are some; empty where they are not known.
void VisibleNodes::find_in_part(const PatchShape& shape, std::span<const std::uint32_t> among,
                                int depth, ByParts& by) {
  corners_ = corners_of(by.frame(), shape);
  const double factor = point_to_polygon(by.p, by.n, corners_);
  if (factor <= 0.0 || is_shut(by.p, by.own, by.polygon)) return;
  std::vector<std::uint32_t> between;
  bool known = true;
  if (among.empty())
    known = occluders_->find_between({by.p}, corners_, by.own, by.polygon, most_listed, between);
  else
    occluders_->find_among(among, {by.p}, corners_, by.own, by.polygon, between);
  if (known && between.size() <= most_occluders && hide_all(by.p, between))
    return add_visible_parts(by.p, by.n, by.forest, by.least, by.sum, by.tint);
  if (factor <= by.least_factor || depth >= most_part_cuts)
    return by.sample(shape, factor, *occluders_);
  if (!known) between.clear();
  const auto [low, high] = shape.halves(shape.cut({}));
  find_in_part(low, between, depth + 1, by);
  find_in_part(high, between, depth + 1, by);
}

double VisibleNodes::find_by_parts(const Vec3& p, const Vec3& n, std::uint32_t own,
                                   ClusterId shooter, const PatchForest& forest,
                                   std::uint32_t polygon, double least, double least_factor,
                                   Random& random, VisibleNode& found) {
  found = VisibleNode{polygon};
  ByParts by{p,      n,    own, occluders_->global(shooter, polygon), forest, least, least_factor,
             random, found};
  corners_ = corners_of(by.frame(), forest.node(polygon).shape);
  occluders_->panes_between({p}, corners_, own, by.polygon, panes_);
  find_in_part(forest.node(polygon).shape, {}, 0, by);
  found.tint = by.tint.mean();
  return by.variance;
}

/// Adds a visible part's factor and first moment. A part counts as a point at its centroid; it is
/// cut across the slope until its factor times the slope's variation is below `least`. The moments
/// of such a part and of its halves are extrapolated to those of ever smaller ones (Richardson).
void VisibleNodes::add_part(const Vec3& p, const Vec3& n, const PatchForest& forest,
                            const PatchShape& shape, double least, int cuts, VisibleNode& sum) {
  const PatchNode& at = forest.node(sum.node);
  const PolygonFrame& frame = forest.frames()[at.id.root];
  const auto factor = [&](const PatchShape& part) {
    corners_.clear();
    for (const Vec2& c : part.vertices) corners_.push_back(frame.at(c));
    return point_to_polygon(p, n, corners_);
  };
  const double whole = factor(shape);
  if (whole <= 0.0) return;
  const Slope slope = slope_over(forest, sum.node, shape);
  const Vec2 shift = shape.centroid - at.shape.centroid;
  if (whole * slope.rms <= negligible_node * least) return sum.add(whole, shift);
  const Vec2 axis = glm::normalize(slope.along);
  const auto [below, above] = shape.halves({axis, glm::dot(axis, shape.centroid)});
  if (whole * slope.rms > least && cuts > 0) {
    add_part(p, n, forest, below, least, cuts - 1, sum);
    add_part(p, n, forest, above, least, cuts - 1, sum);
    return;
  }
  sum.add(whole, shift);
  sum.moment += 4.0 / 3.0 *
                (factor(below) * (below.centroid - shape.centroid) +
                 factor(above) * (above.centroid - shape.centroid));
}

const VisibleNode* node_around(std::span<const VisibleNode> nodes, const PatchForest& forest,
                               std::uint32_t polygon, const Vec3& y) {
  if (nodes.empty()) return nullptr;
  const auto less = [](const VisibleNode& a, std::uint32_t node) { return a.node < node; };
  for (auto node = static_cast<std::int32_t>(forest.leaf_at(polygon, y)); node >= 0;
       node = forest.node(static_cast<std::size_t>(node)).parent) {
    const auto number = static_cast<std::uint32_t>(node);
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), number, less);
    if (at != nodes.end() && at->node == number) return &*at;
  }
  return nullptr;
}

}  // namespace enfilade
