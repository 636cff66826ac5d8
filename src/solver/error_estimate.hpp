// A-posteriori error estimate of an iteration, from its figures, without a reference solution.
#pragma once

#include <span>

#include "solver/iteration_plan.hpp"

namespace enfilade {

/// Returns the estimated contraction factor of the iteration: the larger of the ratio of the last
/// two changes and the reflected share of the arriving light (a lower bound of the iteration
/// matrix's norm, and its spectral radius where light is even); 0 while unknown. With the coarse
/// correction, which removes the part of the error that reflection carries on, it is the largest of
/// the last three ratios of changes, once there are so many.
double contraction(std::span<const IterationSummary> history);

/// Returns the reflected share of the arriving light, worst band.
double most_reflected(const IterationFigures& figures);

/// Returns all parts of the estimate for the last iteration of `history`.
/// Links: the local error is the relative difference between the patches' irradiance and that of
/// the error samples, less the sampling noise; between samplings it is scaled by the sum of the
/// links' estimated errors. The global error comes from the power balance (unbalanced_share()).
/// Gathered light has the reflected share of both, and local errors cancel in part there, except
/// for what the patches as a whole lack; light taken from the patches has that as well, and the
/// patches' own error in addition. Iterations: the series of the changes to come (§8), and its
/// bound by contraction(). The last change alone, the paper's T, understates it by up to 1 / (1 -
/// contraction). `surfaces`: surfaces_power() of energy_conservation.hpp.
ErrorEstimate estimate_error(std::span<const IterationSummary> history,
                             const SurfacesPower& surfaces);

/// Returns the relative standard deviation of the reflected light that a point gathers: the
/// estimate for gathered light is an L1 mean over all light, of which the reflected share alone is
/// uncertain.
double reflected_error(const IterationSummary& last);

/// Returns the relative noise of one sampled point: mean over the points, worst band; 0 where none
/// was sampled.
double sample_noise(const ErrorSampleSums& sums);

}  // namespace enfilade
