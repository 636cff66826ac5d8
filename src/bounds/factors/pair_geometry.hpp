// Distances, heights and kernels between two polygons that face each other.
#pragma once

#include "bounds/factors/flat_shape.hpp"

namespace enfilade {

/// An interval.
struct Range {
  double lo = 0.0, hi = 0.0;
  double width() const { return hi - lo; }
};

/// Returns a lower bound of the distance between two convex polygons, m: the largest gap that the
/// frames of both planes and the line between the centres show; 0 where they touch.
double least_distance(const FlatShape& a, const FlatShape& b);
/// Returns the largest distance of a point of one from a point of the other, m.
double largest_distance(const FlatShape& a, const FlatShape& b);

/// The largest part of a hemisphere about `n` that can be filled by fronts with the normal `m`:
/// both hemispheres' common lune, (1 - n.m) / 2.
double most_by_facing(const Vec3& n, const Vec3& m);

/// Bounds of the kernel K = cos cos' / (pi r^2), 1/m2, for all pairs of points of two shapes that
/// lie in front of each other. With a(y) the height of y above the receiver's plane and b(x) that
/// of x above the shooter's, K = a(y) b(x) / (pi r^4): a depends on y alone, b on x alone, both
/// affine, so that their extremes lie at corners.
Range kernel_range(const FlatShape& receiver, const FlatShape& shooter);

/// The same where the range of squared distances is known.
Range kernel_range(const FlatShape& receiver, const FlatShape& shooter, const Range& squared_m2);

/// Range of the signed distances of a polygon's corners from a plane, m, at least 0.
Range heights(const FlatShape& shape, const Plane& plane);

/// Bounds of the squared distance between points of two shapes, m2.
Range squared_distances(const FlatShape& a, const FlatShape& b);

/// Half width over middle of a range of squared distances; 1 for an empty one.
double spread(const Range& squared_m2);

}  // namespace enfilade
