// How far the next iteration extrapolates the light (gather/extrapolate.hpp).
#pragma once

#include <span>

#include "solver/iteration_plan.hpp"

namespace enfilade {

struct ExtrapolationWeights {
  /// First guess of what an iteration with the coarse correction leaves of an error, over the
  /// reflected share of the light: the sides of a corner exchange about so much of their light.
  double first_share = 0.85;
  /// The guess stays below this: a method of second order diverges slowly where it is too high.
  double most = 0.9;
  /// Where the light moves as much as no_rest times as far after `patience` iterations that were
  /// extrapolated alike, it is extrapolated no more: light that contracts by 0.99 moves less.
  std::size_t patience = 8;
  double no_rest = 0.95;
};

/// Returns IterationPlan::extrapolation of `plan`, the one that follows `history`. None while links
/// are refined, or without the coarse correction, which takes care of the aggregates' power. The
/// first iteration after that keeps the light; from the second on the light is extrapolated for the
/// largest contraction factor that the changes have shown since (Hageman and Young 1981, adaptive
/// parameters). None either once the light has not come to rest so, until links are refined again.
double extrapolation_of(const IterationPlan& plan, std::span<const IterationSummary> history,
                        const ExtrapolationWeights& weights = {});

}  // namespace enfilade
