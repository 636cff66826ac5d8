// The terms of a link's error: what the affine transport from four points misses. A patch receives
// irradiance per unit of the shooter's radiosity e(x); the terms estimate the mean of |e - fit|
// over the patch. Error-driven refinement of links: Lischinski, Smits and Greenberg 1994 ("Bounds
// and error estimates for radiosity"), who bound a link by the extremes of its kernel; here the
// kernel's variation is sampled instead, and visibility is counted with it.
#pragma once

#include "links/four_point_fit.hpp"

namespace enfilade {

/// What is known of e(x), with visibility, for the error terms.
struct ReceiverSamples {
  FourPointFit fit;     ///< to the visible factors
  double center = 0.0;  ///< visible factor at the centre
  double rim = 0.0;     ///< PointFactors::rim
  double missed = 0.0;  ///< by how much the four points' mean differed from the exact total
  double seen = 0.0;    ///< mean share of the shooter that is visible
  double unfit = 0.0;   ///< PairVisibility::unfit
};

/// Curvature along both axes, from the difference between the centre and the mean of the four
/// points: for e = x^2 + y^2 on a square the mean misfit is 0.52 of that difference.
double curvature_error(double center, double mean);
/// The mixed second derivative: for e = x y on a square the mean misfit is 3/4 of the saddle.
double saddle_error(double saddle);
/// The slopes that a constant basis leaves out: for an affine e on a square the mean absolute
/// deviation is 0.82 to 0.87 of the slope per standard deviation, by its direction.
double slope_error(double slope1, double slope2);
/// A shooter that mainly the receiver's corners face: at most the corners' largest factor, over a
/// quarter of the area.
double rim_error(double rim, double seen);
/// A peak between the receiver's points: the total was exact, its distribution over the receiver is
/// not. Bounded by the difference that the points had from the total.
double peak_error(double missed, double seen);

/// All terms of one receiving patch; `terms` per band of its basis (1 or 3).
double receiver_error(const ReceiverSamples& samples, int terms);

/// Uncertain visibility of the shooter: `area_factor` is the receiver's area times the largest
/// known factor (m2), `uncertainty` that of the mean visible share (PairVisibility::uncertainty).
double visibility_error(double area_factor, double uncertainty);

}  // namespace enfilade
