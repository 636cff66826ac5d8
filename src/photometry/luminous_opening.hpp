// The luminous opening of a luminaire: what its light comes from.
#pragma once

#include <string>
#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

enum class OpeningShape {
  point,
  rectangle,       ///< across the aim
  disc,            ///< or ellipse, across the aim
  box,             ///< with luminous sides
  cylinder,        ///< or elliptical; its axis along the aim
  cylinder_right,  ///< lies along the luminaire's x axis (C = 0)
  cylinder_up,     ///< lies along the luminaire's y axis (C = 90)
  ellipsoid,       ///< or sphere
  upright_disc,    ///< or ellipse; its normal along the luminaire's x axis
};
const char* name_of(OpeningShape shape);

/// In the luminaire's own frame (photometry/intensity_distribution.hpp), about its middle.
struct LuminousOpening {
  OpeningShape shape = OpeningShape::point;
  Vec3 size{0.0};  ///< extents along x, y and the aim, metres

  /// Returns the flat polygons that the light is spread over; none of a point. An ellipse is a
  /// polygon of 24 sides and the same area. Solids with curved sides are boxes: a cylinder has the
  /// cross-section's area, an ellipsoid the second moments of its surface.
  std::vector<std::vector<Vec3>> faces() const;
};

/// Returns "0.600 x 0.300 m rectangle".
std::string described(const LuminousOpening& opening);

/// The shape by the signs of an LM-63 file's sizes (metres, `year` of the standard): negative ones
/// are curved, with another code in 1986 to 1991, in 1995, and from 2002 on. The length lies along
/// the half-planes 0 and 180, the width along 90 and 270. `known`: false where the standard has no
/// such code; a shape of that size is returned then.
LuminousOpening opening_by_lm63(int year, double width, double length, double height, bool& known);

}  // namespace enfilade
