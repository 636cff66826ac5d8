// Where the rays from a point end, and how sure the light is that they read there.
#pragma once

#include <algorithm>
#include <span>

#include "hierarchy/patch_forest.hpp"

namespace enfilade {

/// Of all rays from one point, and of the paths that they begin.
struct RayEnds {
  int front = 0, back = 0;  ///< rays that end on front sides, and on back sides
  /// Light that is read off patches and that these reflect, largest band; and the error of it by
  /// the links of the leaves, PatchForest::link_error(). Light by rays to picked bright polygons
  /// and of panes is not counted.
  double reflected = 0.0, uncertain = 0.0;

  /// Counts what a path that carries `carried` (per band) reads off a leaf of a polygon.
  void read(const PatchForest& patches, std::size_t leaf, std::span<const double> carried,
            std::span<const double> radiosity) {
    const BandValues& exitance = patches.frames()[patches.node(leaf).id.root].exitance;
    const auto terms = static_cast<std::size_t>(patches.terms());
    double here = 0.0, mean = 0.0;
    for (std::size_t b = 0; b < static_cast<std::size_t>(patches.lead_bands()); ++b) {
      here = std::max(here, carried[b] * (radiosity[b] - exitance[b]));
      mean = std::max(mean, carried[b] * (patches.radiosity(leaf)[b * terms] - exitance[b]));
    }
    reflected += here;
    uncertain += mean * patches.link_error(leaf);  // which is relative to the leaf's mean
  }
  /// Returns how many times the error of the light that is read exceeds that of the patches' light
  /// all over, of which `mean` is the link_error(). Dark rooms behind a door, or a gap beside a
  /// window, get their light over links that bring little of all light and are as coarse. Never
  /// below 1: how large the error is was measured all over, the links only tell where it lies.
  double doubt(double mean) const {
    return mean > 0.0 && reflected > 0.0 ? std::max(1.0, uncertain / (mean * reflected)) : 1.0;
  }
};

}  // namespace enfilade
