// Power balance: emitted power must be absorbed or escape. Row closure (gather/row_closure.hpp)
// corrects the receivers' rows; the flux correction corrects what the columns lack.
#pragma once

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

/// Returns IterationPlan::flux_correction for the iteration after `last`. It distributes lost power
/// over patches by their uncertain irradiance, at most all of it. Unchanged while the share lost is
/// below `tolerance` or below four times the estimated iteration error, and while rows are not
/// closed.
Spectrum flux_correction(const IterationSummary& last, const SurfacesPower& surfaces,
                         double tolerance);

}  // namespace enfilade
