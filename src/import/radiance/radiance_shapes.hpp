// The shapes of Radiance as polygons, each counter-clockwise seen from its front.
#pragma once

#include "geometry/polygon.hpp"
#include "import/radiance/radiance_primitive.hpp"

namespace enfilade {

/// Round shapes get this many sides, and spheres half as many bands from pole to pole.
constexpr int radiance_sides = 24, radiance_sphere_sides = 16;

/// A polygon as it is, any other shape cut into planar, convex polygons. Rings, cylinders and cones
/// share one polygon in place of their circles, of the circle's area: rings have the true area,
/// round walls 0.3 % more than it, and a cap fits its pipe. Spheres have the true area.
std::vector<Polygon> radiance_polygons(const RadiancePrimitive& shape);

}  // namespace enfilade
