// One round of refinement: the links and receivers that widen the targets most are cut.
#pragma once

#include "bounds/iteration/bound_state.hpp"

namespace enfilade {

struct BoundsRefinementConfig {
  /// Of all links, those that are looked at in a round; and the links that a round may add, of
  /// those that there are.
  double chosen_share = 0.3, growth = 0.35;
  std::size_t least_chosen = 400, least_growth = 3000;
  /// A shooter is cut rather than the receiver if its size is at least this share of the
  /// receiver's.
  double shooter_share = 0.5;
  /// Weight of what widens the bounds at points, which others see as a covariance, beside what
  /// widens means.
  double point_weight = 0.25;
};

/// Cuts; returns the number of links that were evaluated. `weights[polygon * bands + band]`: how
/// much a unit of width of the polygon's mean irradiance times its area counts.
std::size_t refine(BoundState& state, std::span<const double> weights,
                   const BoundsRefinementConfig& config = {});

}  // namespace enfilade
