// Guaranteed intervals of the mean irradiance of polygons and of sets of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "bounds/factors/pair_geometry.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// A planar convex polygon that reflects and emits diffusely from its front, and blocks light from
/// both sides.
struct BoundPolygon {
  Polygon polygon;
  Spectrum reflectance, exitance;  ///< per band
  Spectrum transmittance{};        ///< of a pane, at most, per band; empty: opaque
  bool pane = false;               ///< hides nothing; the back of one has no transmittance
};

struct BoundScene {
  std::size_t bands = 1;
  std::vector<BoundPolygon> polygons;
  std::vector<LightSource> lights;
  /// Sets of polygons (rooms of a building) whose means are asked for. They steer the refinement.
  std::vector<std::vector<std::uint32_t>> targets;
};

struct BoundConfig {
  double relative_width = 0.1;  ///< of all targets, wanted: (upper - lower) / middle
  std::size_t most_links = 1'000'000;
  double most_seconds = 0.0;  ///< 0: as many as it takes
  int threads = 1;
};

enum class BoundStop { reached, links, seconds, finest };

struct BoundResult {
  std::vector<std::vector<Range>> polygons;  ///< mean irradiance: [polygon][band]
  std::vector<std::vector<Range>> targets;   ///< area-weighted mean: [target][band]
  std::vector<Range> scene;                  ///< of all polygons: [band]
  BoundStop stop = BoundStop::reached;
  std::size_t links = 0, patches = 0, closed_polygons = 0;
  int rounds = 0;
};

/// (upper - lower) / middle; 0 where both are 0.
double relative_width(const Range& range);

/// The widest of the targets' intervals, relative, in any band.
double widest(std::span<const std::vector<Range>> ranges);

/// Bounds the solution of B = M + rho E, E = K B + direct light, where K sums over all polygons
/// that a point sees. Receivers are the leaves of a tree of patches; each has one row of links that
/// together hold all shooters: patches, polygons, or groups of these. A link has bounds of the form
/// factor (pair_factor.hpp), a row gives bounds of the irradiance (row_bounds.hpp), and these are
/// iterated from global bounds: each step keeps the solution inside (Lischinski, Smits and
/// Greenberg 1994, "Bounds and error estimates for radiosity"). In each round the links and
/// receivers that widen the targets most are cut. A round depends on the rounds before it alone,
/// and bounds are only ever intersected: more links never give a wider interval. The intervals hold
/// but for rounding, for the scene as these polygons describe it; what is thinner than 1e-7 of its
/// extent touches.
BoundResult bound_irradiance(const BoundScene& scene, const BoundConfig& config,
                             const Progress& progress = {});

}  // namespace enfilade
