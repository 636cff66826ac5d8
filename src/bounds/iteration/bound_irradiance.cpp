#include "bounds/iteration/bound_irradiance.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "bounds/iteration/energy_bounds.hpp"
#include "bounds/iteration/refinement.hpp"

namespace enfilade {
namespace {

constexpr int most_sweeps = 60;      ///< of a round
constexpr double settled = 0.003;    ///< relative change of all widths that ends a round
constexpr double least_step = 0.01;  ///< of the rows' references

void keep_narrower(std::vector<std::vector<Range>>& kept,
                   const std::vector<std::vector<Range>>& found) {
  if (kept.empty()) {
    kept = found;
    return;
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t band = 0; band < kept[i].size(); ++band) {
      kept[i][band].lo = std::max(kept[i][band].lo, found[i][band].lo);
      kept[i][band].hi = std::min(kept[i][band].hi, found[i][band].hi);
    }
  }
}

/// Reads the state into the results, each bound only ever narrower.
void collect(const BoundState& state, BoundResult& result) {
  const BoundScene& scene = state.scene();
  std::vector<std::vector<Range>> polygons;
  for (const std::uint32_t node : state.tree().polygon_nodes()) {
    std::vector<Range>& ranges = polygons.emplace_back();
    for (std::size_t band = 0; band < scene.bands; ++band)
      ranges.push_back(state.irradiance(node, band).mean);
  }
  keep_narrower(result.polygons, polygons);
  const bool closed = state.closed_polygons() == scene.polygons.size() && state.lights_enclosed();
  std::vector<double> areas;
  for (const std::uint32_t node : state.tree().polygon_nodes())
    areas.push_back(state.tree()[node].area_m2);
  const EnergyBounds energy(scene, areas, closed);
  energy.narrow(result.polygons);
  keep_narrower(result.targets, energy.means(scene.targets, result.polygons));
  std::vector<std::uint32_t> all(scene.polygons.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<std::vector<Range>> whole;
  if (!result.scene.empty()) whole.push_back(result.scene);
  const std::vector<std::vector<std::uint32_t>> one_set{all};
  keep_narrower(whole, energy.means(one_set, result.polygons));
  result.scene = whole.front();
}

void settle(BoundState& state, BoundResult& result) {
  double width = 1e300, step = 0.2;
  for (int i = 0; i < most_sweeps; ++i) {
    state.sweep(step);
    step = std::max(least_step, 0.7 * step);
    if (i >= 3 && i % 4 == 3) state.leap(step);
    const double now = state.total_width();
    if (i >= 3 && now >= width * (1.0 - settled)) break;
    width = now;
  }
  collect(state, result);
}

/// A unit of width counts in a target relative to the target's light; outside of all targets
/// little.
std::vector<double> weights_of(const BoundState& state, const BoundResult& result) {
  const BoundScene& scene = state.scene();
  const std::size_t bands = scene.bands;
  std::vector<double> weights(scene.polygons.size() * bands, 0.0);
  const auto add = [&](std::span<const std::uint32_t> polygons, const std::vector<Range>& ranges,
                       double factor) {
    double area = 0.0;
    for (const std::uint32_t k : polygons)
      area += state.tree()[state.tree().polygon_nodes()[k]].area_m2;
    for (std::size_t band = 0; band < bands; ++band) {
      const double middle = 0.5 * (ranges[band].lo + ranges[band].hi);
      if (area <= 0.0 || middle <= 0.0) continue;
      for (const std::uint32_t k : polygons) weights[k * bands + band] += factor / (area * middle);
    }
  };
  for (std::size_t t = 0; t < scene.targets.size(); ++t)
    add(scene.targets[t], result.targets[t], 1.0);
  std::vector<std::uint32_t> all(scene.polygons.size());
  std::iota(all.begin(), all.end(), 0u);
  add(all, result.scene, scene.targets.empty() ? 1.0 : 0.25);
  return weights;
}

}  // namespace

double relative_width(const Range& range) {
  const double middle = 0.5 * (range.lo + range.hi);
  return middle > 0.0 ? range.width() / middle : 0.0;
}

double widest(std::span<const std::vector<Range>> ranges) {
  double most = 0.0;
  for (const auto& bands : ranges) {
    for (const Range& range : bands) most = std::max(most, relative_width(range));
  }
  return most;
}

BoundResult bound_irradiance(const BoundScene& scene, const BoundConfig& config,
                             const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  BoundState state(scene, config.threads);
  BoundResult result;
  const double log_links =
      std::log(static_cast<double>(std::max<std::size_t>(config.most_links, 2)));
  for (;; ++result.rounds) {
    settle(state, result);
    const std::size_t links = state.links();
    report_progress(progress, "bounds",
                    std::min(1.0, std::log(static_cast<double>(links + 1)) / log_links));
    const double width =
        scene.targets.empty() ? relative_width(result.scene.front()) : widest(result.targets);
    if (width <= config.relative_width)
      result.stop = BoundStop::reached;
    else if (links >= config.most_links)
      result.stop = BoundStop::links;
    else if (config.most_seconds > 0.0 && seconds() >= config.most_seconds)
      result.stop = BoundStop::seconds;
    else if (refine(state, weights_of(state, result)) > 0)
      continue;
    else
      result.stop = BoundStop::finest;
    break;
  }
  result.links = state.links();
  result.patches = state.receivers().size();
  result.closed_polygons = state.closed_polygons();
  return result;
}

}  // namespace enfilade
