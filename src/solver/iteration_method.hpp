// Whose light a gather takes: this iteration's or the last one's.
#pragma once

#include <span>

#include "coarse/coarse_unknowns.hpp"
#include "solver/iteration_plan.hpp"

namespace enfilade {

/// How the linear system of radiosities is iterated.
/// Jacobi        every gather takes the light of the last iteration (the committed light)
/// Gauss-Seidel  a gather takes the newest light of those clusters that its own rank has gathered
///               for in this iteration: the paper's group iteration (§8)
/// Hybrid, the default: with the coarse correction Jacobi in all iterations, since extrapolation
/// needs the light of one iteration, but after a correction that failed; Gauss-Seidel without it.
struct IterationMethod {
  bool coarse_correction = true;  ///< false: the paper's group iteration as it is
  bool jacobi = false;            ///< Jacobi in every iteration

  /// Returns the unknowns of the coarse correction; without it, one aggregate per cluster.
  CoarseUnknowns unknowns(std::span<const Cluster> clusters) const {
    return coarse_correction ? coarse_unknowns(clusters) : coarse_unknowns(clusters, 1);
  }
  /// True where the iteration of `plan` is a Jacobi iteration. Which links are refined must not
  /// depend on the ranks' number and speeds, so refining iterations must be Jacobi iterations; the
  /// coarse correction makes up for the slower convergence. Where a cluster has several aggregates,
  /// all receivers must read the same light of all of them, since otherwise a shift of light
  /// between aggregates would be counted as a change of power; and what is extrapolated must be the
  /// light of one iteration.
  bool uses_jacobi(const IterationPlan& plan, const CoarseUnknowns& unknowns) const {
    return jacobi || (coarse_correction && (plan.refine || plan.sample ||
                                            plan.extrapolation >= 1.0 || unknowns.aggregated()));
  }
};

}  // namespace enfilade
