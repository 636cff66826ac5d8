#include "bounds/iteration/bound_state.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/run_on_threads.hpp"
#include "bounds/factors/closed_fronts.hpp"
#include "bounds/iteration/direct_bounds.hpp"

namespace enfilade {
namespace {

std::vector<Polygon> polygons_of(const BoundScene& scene) {
  std::vector<Polygon> polygons;
  for (const BoundPolygon& p : scene.polygons) polygons.push_back(p.polygon);
  return polygons;
}

/// B = M + rho E; where all of a node's light is of one polygon.
LightRange reflected(const LightRange& e, double reflectance, double exitance) {
  const auto b = [&](double x) { return exitance + reflectance * x; };
  return {{b(e.mean.lo), b(e.mean.hi)},
          {b(e.at_points.lo), b(e.at_points.hi)},
          reflectance * e.deviation};
}

double sum_of_widths(std::span<const LightRange> light) {
  double sum = 0.0;
  for (const LightRange& l : light) sum += l.mean.width();
  return sum;
}

/// From `now` on, all of `share` of the way that the bounds have gone since `before`.
LightRange further(const LightRange& before, const LightRange& now, double share) {
  const auto go = [share](const Range& old, const Range& fresh) {
    Range r{fresh.lo + share * (fresh.lo - old.lo), fresh.hi + share * (fresh.hi - old.hi)};
    return r.lo <= r.hi ? r : fresh;
  };
  LightRange guess{go(before.mean, now.mean), go(before.at_points, now.at_points)};
  guess.deviation = std::max(0.0, now.deviation + share * (now.deviation - before.deviation));
  guess.at_points.lo = std::min(guess.at_points.lo, guess.mean.lo);
  guess.at_points.hi = std::max(guess.at_points.hi, guess.mean.hi);
  return guess;
}

/// Of two parts together: the mean of their means, the hull of what their points have, and the
/// deviation within and between them.
LightRange joined(const LightRange& a, const LightRange& b, double share_a) {
  const double share_b = 1.0 - share_a;
  const double apart = std::max(a.mean.hi - b.mean.lo, b.mean.hi - a.mean.lo);
  LightRange both{
      {share_a * a.mean.lo + share_b * b.mean.lo, share_a * a.mean.hi + share_b * b.mean.hi},
      {std::min(a.at_points.lo, b.at_points.lo), std::max(a.at_points.hi, b.at_points.hi)}};
  both.deviation = std::min(most_deviation(both), std::sqrt(share_a * a.deviation * a.deviation +
                                                            share_b * b.deviation * b.deviation +
                                                            share_a * share_b * apart * apart));
  return both;
}

bool holds(const Range& outer, const Range& inner) {
  return outer.lo <= inner.lo && inner.hi <= outer.hi;
}

}  // namespace

void for_all(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  constexpr std::size_t chunk = 16;
  std::atomic<std::size_t> next{0};
  run_on_threads(threads, [&](bool) {
    for (std::size_t begin = next.fetch_add(chunk); begin < count; begin = next.fetch_add(chunk)) {
      for (std::size_t i = begin; i < std::min(count, begin + chunk); ++i) work(i);
    }
  });
}

BoundState::BoundState(const BoundScene& scene, int threads)
    : scene_(scene),
      threads_(threads),
      polygons_(polygons_of(scene)),
      panes_(scene),
      factors_(polygons_, panes_.flags()),
      groups_(polygons_, factors_.tolerance_m(), panes_.flags()),
      tree_(polygons_) {
  std::vector<Vec3> lights;
  for (const LightSource& light : scene.lights) lights.push_back(light.p);
  ClosedFronts fronts = closed_fronts(polygons_, lights, factors_.tolerance_m());
  closed_ = std::move(fronts.polygons);
  // Light that passes a pane is dimmed: no row sums to 1.
  if (panes_.any()) std::fill(closed_.begin(), closed_.end(), 0);
  lights_enclosed_ =
      !panes_.any() &&
      std::all_of(fronts.points.begin(), fronts.points.end(), [](char c) { return c; }) &&
      std::all_of(scene.lights.begin(), scene.lights.end(),
                  [](const LightSource& light) { return light.opening.empty(); });
  receivers_.resize(polygons_.size());
  for (std::size_t k = 0; k < polygons_.size(); ++k) {
    receivers_[k].node = tree_.polygon_nodes()[k];
    receivers_[k].references.resize(scene.bands);
    if (!tree_[0].is_leaf()) receivers_[k].links = {{0, factor(receivers_[k].node, 0, false)}};
  }
  for_all(receivers_.size(), threads_, [&](std::size_t i) { set_direct(receivers_[i]); });
  start_with_global_bounds();
}

std::size_t BoundState::links() const {
  std::size_t sum = 0;
  for (const Receiver& r : receivers_) sum += r.links.size();
  return sum;
}

std::size_t BoundState::closed_polygons() const {
  return static_cast<std::size_t>(std::count(closed_.begin(), closed_.end(), 1));
}

void BoundState::set_direct(Receiver& receiver) const {
  const BoundNode& node = tree_[receiver.node];
  receiver.direct.assign(scene_.bands, {});
  for (const LightSource& light : scene_.lights) {
    const PatchOfPolygon patch{node.shape, node.polygon};
    const LightRange g = light.opening.empty() ? direct_bounds(light.p, patch, factors_)
                                               : opening_bounds(light, patch, factors_);
    if (g.at_points.hi <= 0.0) continue;
    for (std::size_t band = 0; band < scene_.bands; ++band) {
      const Range i = intensity_towards(light, band, node.shape);
      LightRange& sum = receiver.direct[band];
      sum.mean.lo += i.lo * g.mean.lo;
      sum.mean.hi += i.hi * g.mean.hi;
      sum.at_points.lo += i.lo * g.at_points.lo;
      sum.at_points.hi += i.hi * g.at_points.hi;
      sum.deviation += most_deviation(
          {{i.lo * g.mean.lo, i.hi * g.mean.hi}, {i.lo * g.at_points.lo, i.hi * g.at_points.hi}});
    }
  }
}

PairFactor BoundState::factor(std::uint32_t leaf, std::uint32_t shooter, bool known_open) const {
  const BoundNode &receiver = tree_[leaf], &from = tree_[shooter];
  if (from.polygon == receiver.polygon) return {};
  if (!from.is_group() && panes_.is_dark(from.polygon)) return {};
  PairFactor none;
  const double most = GroupSight::most_factor(receiver.shape, from.box);
  if (most <= 0.0) return none;
  if (!known_open) {
    std::vector<Vec3> corners = from.shape.polygon;
    if (from.is_group()) {
      const auto all = from.box.corners();
      corners.assign(all.begin(), all.end());
    }
    if (groups_.hidden(receiver.shape, receiver.polygon, corners, from.polygon)) return none;
  }
  if (!from.is_group())
    return factors_({receiver.shape, receiver.polygon}, {from.shape, from.polygon}, known_open);
  PairFactor group;
  const double all = panes_.most_sum() * most;
  group.mean = {0.0, all};
  group.at_points = {0.5 * all, Vec3(0.0), 0.5 * all};
  group.mean_spread = group.point_spread = 1e300;  // its mean says nothing of what is seen of it
  return group;
}

void BoundState::split_receiver(std::size_t receiver) {
  const std::uint32_t whole = receivers_[receiver].node, first = tree_.split(whole);
  for (std::uint32_t child = first; child < first + 2; ++child) {
    for (std::size_t band = 0; band < scene_.bands; ++band) {
      const LightRange e = irradiance(whole, band), b = radiosity(whole, band);
      irradiance_.push_back({e.at_points, e.at_points, 0.5 * e.at_points.width()});
      radiosity_.push_back({b.at_points, b.at_points, 0.5 * b.at_points.width()});
    }
  }
  Receiver half;
  half.references = receivers_[receiver].references;
  half.node = first + 1;
  set_direct(half);
  receivers_[receiver].node = first;
  receivers_[receiver].links.clear();
  receivers_[receiver].walls.clear();
  set_direct(receivers_[receiver]);
  receivers_.push_back(std::move(half));
}

std::vector<LightRange> BoundState::of_receivers() const {
  std::vector<LightRange> all;
  all.reserve(receivers_.size() * scene_.bands);
  for (const Receiver& r : receivers_) {
    for (std::size_t band = 0; band < scene_.bands; ++band) all.push_back(irradiance(r.node, band));
  }
  return all;
}

std::vector<LightRange> BoundState::step_of_all_rows(double step) {
  const std::size_t bands = scene_.bands;
  std::vector<LightRange> found(receivers_.size() * bands);
  for_all(receivers_.size(), threads_, [&](std::size_t i) {
    Receiver& r = receivers_[i];
    const BoundNode& node = tree_[r.node];
    for (std::size_t band = 0; band < bands; ++band) {
      const BoundRow row{r.links,
                         r.walls,
                         radiosity_,
                         bands,
                         band,
                         node.shape.radius_m,
                         closed(node.polygon),
                         panes_.most_sum()};
      LightRange e = bound_row(row, step, r.references[band]);
      const LightRange& direct = r.direct[band];
      e.mean.lo += direct.mean.lo;
      e.mean.hi += direct.mean.hi;
      e.at_points.lo += direct.at_points.lo;
      e.at_points.hi += direct.at_points.hi;
      e.deviation += direct.deviation;
      found[i * bands + band] = e;
    }
  });
  return found;
}

void BoundState::set_leaves(const std::vector<LightRange>& of_receivers) {
  for (std::size_t i = 0; i < receivers_.size(); ++i) {
    for (std::size_t band = 0; band < scene_.bands; ++band)
      irradiance_[receivers_[i].node * scene_.bands + band] = of_receivers[i * scene_.bands + band];
  }
  pull();
}

/// From the leaves to the root: means of means, hulls of what points have.
void BoundState::pull() {
  const std::size_t bands = scene_.bands;
  for (std::size_t k = tree_.size(); k-- > 0;) {
    const BoundNode& node = tree_[k];
    for (std::size_t band = 0; band < bands; ++band) {
      if (!node.is_leaf()) {
        const std::size_t a = node.first_child * bands + band, b = a + bands;
        const double share =
            node.area_m2 > 0.0 ? tree_[node.first_child].area_m2 / node.area_m2 : 0.5;
        irradiance_[k * bands + band] = joined(irradiance_[a], irradiance_[b], share);
        radiosity_[k * bands + band] = joined(radiosity_[a], radiosity_[b], share);
      } else if (!node.is_group()) {
        const BoundPolygon& p = scene_.polygons[node.polygon];
        radiosity_[k * bands + band] =
            reflected(irradiance_[k * bands + band], p.reflectance[band], p.exitance[band]);
      }
    }
  }
}

void BoundState::sweep(double step) {
  std::vector<LightRange> now = of_receivers();
  before_ = now;
  const std::vector<LightRange> found = step_of_all_rows(step);
  for (std::size_t i = 0; i < now.size(); ++i) now[i].intersect(found[i]);
  set_leaves(now);
  change_before_ = change_;
  change_ = sum_of_widths(before_) - sum_of_widths(now);
}

double BoundState::total_width() const {
  double sum = 0.0;
  for (const Receiver& r : receivers_) {
    for (std::size_t band = 0; band < scene_.bands; ++band) {
      const LightRange& e = irradiance(r.node, band);
      sum += tree_[r.node].area_m2 * (e.mean.width() + e.at_points.width());
    }
  }
  return sum;
}

bool BoundState::leap(double step) {
  if (change_ <= 0.0 || change_before_ <= change_) return false;
  const double ratio = std::min(0.9999, change_ / change_before_);
  const std::vector<LightRange> now = of_receivers();
  std::vector<LightRange> guess = now;
  for (std::size_t i = 0; i < now.size(); ++i)
    guess[i] = further(before_[i], now[i], 0.9 * ratio / (1.0 - ratio));
  set_leaves(guess);
  const std::vector<LightRange> found = step_of_all_rows(step);
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!holds(guess[i].mean, found[i].mean) || !holds(guess[i].at_points, found[i].at_points) ||
        found[i].deviation > guess[i].deviation) {
      set_leaves(now);
      return false;
    }
  }
  return true;
}

}  // namespace enfilade
