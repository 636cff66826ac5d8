// Power balance: emitted power must be absorbed or escape. Row closure (gather/row_closure.hpp)
// corrects the receivers' rows; the flux correction corrects what the columns lack.
#pragma once

#include <span>

#include "scene/scene.hpp"
#include "solver/iteration_plan.hpp"

namespace enfilade {

/// Returns, per band, the power emitted by surfaces: `emitted` without point lights, whose direct
/// power is measured where it arrives (IterationFigures::direct_power).
SurfacesPower surfaces_power(const Scene& scene, Spectrum emitted);

/// Returns the share of the sent power (emitted by surfaces, and direct power of point lights) that
/// is neither absorbed nor seen to escape, in band b; negative where more is absorbed than sent.
/// `surfaces`: surfaces_power().
double unbalanced_share(const IterationFigures& figures, const SurfacesPower& surfaces,
                        std::size_t b);

/// Returns IterationPlan::flux_correction for the iteration after the last of `history`. It
/// distributes lost power over patches by their uncertain irradiance, at most all of it. With the
/// coarse correction, the power that will be lost in the end is foretold from the last iterations,
/// so that the light need not come to rest after each change. Unchanged while that share is below
/// `tolerance`, and while rows are not closed; without the coarse correction also while the share
/// is below four times the estimated iteration error.
Spectrum flux_correction(std::span<const IterationSummary> history, const SurfacesPower& surfaces,
                         double tolerance);

}  // namespace enfilade
