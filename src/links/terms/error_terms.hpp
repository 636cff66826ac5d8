// The terms of a link's error: the residual of the affine fit to four points, and the effects that
// the four points do not see. A patch receives irradiance per unit of the shooter's radiosity e(x);
// the terms estimate the mean of |e - fit| over the patch. Error-driven refinement of links:
// Lischinski, Smits and Greenberg 1994 ("Bounds and error estimates for radiosity"), who bound a
// link by the extremes of its kernel; here the kernel's variation is sampled instead, and
// visibility is counted with it.
#pragma once

#include "links/terms/four_point_fit.hpp"

namespace enfilade {

/// Samples of e(x), with visibility, for the error terms.
struct ReceiverSamples {
  FourPointFit fit;     ///< to the visible factors
  double center = 0.0;  ///< visible factor at the centre
  double rim = 0.0;     ///< PointFactors::rim
  double missed = 0.0;  ///< difference of the four points' mean from the exact total
  double seen = 0.0;    ///< mean share of the shooter that is visible
  double unfit = 0.0;   ///< PairVisibility::unfit
};

/// Returns the error by curvature along both axes, from the difference between the centre and the
/// mean of the four points: for e = x^2 + y^2 on a square the mean misfit is 0.52 of that
/// difference.
double curvature_error(double center, double mean);
/// Returns the error by the mixed second derivative: for e = x y on a square the mean misfit is 3/4
/// of the saddle.
double saddle_error(double saddle);
/// Returns the error by the slopes that a constant basis leaves out: for an affine e on a square
/// the mean absolute deviation is 0.82 to 0.87 of the slope per standard deviation, by its
/// direction.
double slope_error(double slope1, double slope2);
/// Returns the error by a shooter that mainly the receiver's corners face: at most the corners'
/// largest factor, over a quarter of the area.
double rim_error(double rim, double seen);
/// Returns the error by a peak between the receiver's points: the total is exact, its distribution
/// over the receiver is not. Bounded by the difference of the points' mean from the total.
double peak_error(double missed, double seen);

/// Returns the sum of all terms of one receiving patch; `terms`: coefficients per band of its basis
/// (1 or 3).
double receiver_error(const ReceiverSamples& samples, int terms);

/// Returns the error by uncertain visibility of the shooter: `area_factor` is the receiver's area
/// times the largest known factor (m2), `uncertainty` that of the mean visible share
/// (PairVisibility::uncertainty).
double visibility_error(double area_factor, double uncertainty);

}  // namespace enfilade
