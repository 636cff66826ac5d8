// The balance of light: what is sent out must be absorbed or leave. Closed rows (row_closure.hpp)
// see to each receiver's form factors; what the shooters' columns lack is mended here.
#pragma once

#include "scene/scene.hpp"
#include "solver/iteration_plan.hpp"

namespace enfilade {

/// What of the emitted power surfaces send out. How much of the point lights' leaves at once is not
/// measured: what arrives of theirs is taken for what they send.
Spectrum surfaces_power(const Scene& scene, Spectrum emitted);

/// Share of the light that surfaces send and point lights bring in which was lost between surfaces
/// (or made: negative), in band b. More absorbed than that is always wrong; less is right as far as
/// the rest was seen to leave, or may have ended on a black side. `surfaces`: surfaces_power().
double unbalanced_share(const IterationFigures& figures, const Spectrum& surfaces, std::size_t b);

/// IterationPlan::flux_correction for the iteration after `last`: what is lost goes to where the
/// links are in uncertainty, each patch by its share of that, and never more than all of the doubt.
/// As it was where the iterations to come may still bring a quarter of what is lost, or no more
/// than `tolerance` is.
Spectrum flux_correction(const IterationSummary& last, const Spectrum& surfaces, double tolerance);

}  // namespace enfilade
