// How wrong the light of an iteration is, told from what its gathers brought, without the answer.
#pragma once

#include <span>

#include "solver/iteration_plan.hpp"

namespace enfilade {

/// Share of the error that one iteration passes on to the next: the larger of what the last changes
/// show and of what share of the arriving light has been reflected (a lower bound of the iteration
/// matrix's norm, and its spectral radius where light is even); 0 where there is no telling yet.
/// Where the coarse system has taken out what reflection carries on, the largest of the last three
/// ratios of changes, once there are so many.
double contraction(std::span<const IterationSummary> history);

/// All parts, for the last of `history`.
/// Links: where points were sampled, the light gathered anew differs from that of the patches by
/// what is wrong from place to place (less the sampling's own noise); that follows the sum of the
/// links' errors until points are sampled again. What is wrong all over shows in the balance of
/// light. A point that is gathered for sees only the share of this that is reflected, and local
/// errors cancel there; a patch sees that too, beside what is wrong with its own light.
/// Iterations: the series of the changes to come (§8), and its bound by the contraction above. The
/// last change alone, the paper's T, understates it by up to 1 / (1 - contraction).
/// `surfaces`: surfaces_power() of energy_conservation.hpp.
ErrorEstimate estimate_error(std::span<const IterationSummary> history, const Spectrum& surfaces);

/// Relative noise of one sampled point, mean over the points, worst band; 0 where none was sampled.
double sample_noise(const ErrorSampleSums& sums);

}  // namespace enfilade
