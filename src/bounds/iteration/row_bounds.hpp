// Bounds of the irradiance of one receiver from bounds of its form factors and of the radiosities.
#pragma once

#include <cstdint>
#include <span>

#include "bounds/factors/pair_factor.hpp"

namespace enfilade {

/// What is known of the light of a node in one band: of its mean over the area, of its value at
/// every point, and how large its standard deviation over the area can be at most.
struct LightRange {
  Range mean, at_points;
  double deviation = 0.0;
  /// Keeps what both say; the mean lies within the range of the points.
  void intersect(const LightRange& other);
};

struct BoundLink {
  std::uint32_t shooter = 0;  ///< node
  PairFactor factor;
};

/// The parts of one polygon that a row has links from, side by side, and the factor of the whole:
/// the parts' factors sum to it at each point.
struct BoundWall {
  std::uint32_t polygon = 0;
  PairFactor whole;
  std::uint32_t begin = 0, end = 0;  ///< of the row's links
};

/// The reference radiosities of a row's bounds, in one band: any value of at least 0 gives bounds
/// that hold; near the best ones the bounds are narrow. Below 0: none was tried.
struct RowReference {
  double mean_upper = -1.0, mean_lower = -1.0, point_upper = -1.0, point_lower = -1.0;
};

/// A receiver's row.
struct BoundRow {
  std::span<const BoundLink> links{};
  std::span<const BoundWall> walls{};       ///< in the order of the links
  std::span<const LightRange> radiosity{};  ///< of node k in the row's band: [k * bands + band]
  std::size_t bands = 1, band = 0;
  double radius_m = 0.0;  ///< of the receiver
  bool closed = false;    ///< the form factors from each point sum to 1; else to at most `most`
  /// 1; more where a pane that sends light and what is seen through it both count.
  double most = 1.0;
  const LightRange& light(const BoundLink& link) const {
    return radiosity[link.shooter * bands + band];
  }
};

/// Returns bounds of the irradiance that arrives over the links. With a reference radiosity b, the
/// sum of F_j B_j is at most b + the sum of max(F_j (B_j - b)), since the F_j sum to at most 1: the
/// dual of a fractional knapsack. Where they sum to 1 the same holds from below. A wall's parts are
/// bounded likewise against a reference of their own, whose share is that of the wall's factor. The
/// mean of the product of kernel and radiosity over a shooter is the product of the means and a
/// covariance of at most the product of their standard deviations. The references are improved by
/// trials a relative `step` to either side.
LightRange bound_row(const BoundRow& row, double step, RowReference& reference);

/// Largest standard deviation of light with these bounds of its points and its mean.
double most_deviation(const LightRange& light);

}  // namespace enfilade
