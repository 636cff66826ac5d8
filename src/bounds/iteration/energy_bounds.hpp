// Conservation of energy as a bound: what is emitted is absorbed, where nothing escapes.
#pragma once

#include <span>
#include <vector>

#include "bounds/iteration/bound_irradiance.hpp"

namespace enfilade {

/// Light that arrives is absorbed or reflected, and what is reflected or emitted arrives elsewhere
/// or escapes: the sum of area (1 - rho) E is at most the emitted power, and equal to it in a
/// closed scene.
class EnergyBounds {
 public:
  /// `areas_m2` per polygon; `closed`: no light escapes.
  EnergyBounds(const BoundScene& scene, std::vector<double> areas_m2, bool closed);

  /// Narrows each polygon's interval by what the others leave for it.
  void narrow(std::vector<std::vector<Range>>& polygons) const;
  /// Bounds of the area-weighted means over sets of polygons: the extremes over all irradiances
  /// that lie in the polygons' intervals and conserve energy (a fractional knapsack).
  std::vector<std::vector<Range>> means(std::span<const std::vector<std::uint32_t>> sets,
                                        const std::vector<std::vector<Range>>& polygons) const;

 private:
  double absorbed(std::size_t polygon, std::size_t band) const;
  double most(std::span<const std::uint32_t> set, std::size_t band,
              const std::vector<std::vector<Range>>& polygons, double spare) const;

  const BoundScene& scene_;
  std::vector<double> areas_m2_;
  bool closed_;
  std::vector<double> power_;  ///< emitted, per band
};

}  // namespace enfilade
