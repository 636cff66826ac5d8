// The one command of Radiance files that is carried out here: a plain !xform.
#pragma once

#include "geometry/polygon.hpp"
#include "import/radiance_text.hpp"

namespace enfilade {

/// p -> linear p + shift; linear turns, mirrors and scales alike along all axes.
struct RadianceTransform {
  glm::dmat3 linear{1.0};
  Vec3 shift{0.0};

  /// This one first, then `next`.
  RadianceTransform then(const RadianceTransform& next) const;
  /// Returns the image of a polygon, its front still its front: a mirror turns its winding around.
  Polygon image_of(Polygon polygon) const;
};

struct RadianceXform {
  RadianceTransform transform;
  std::string prefix;              ///< of the names of all shapes; may be empty
  std::vector<std::string> files;  ///< as written
};

/// Parses "xform [-n name] [-t x y z] [-rx|-ry|-rz degrees] [-s f] [-mx] [-my] [-mz] file ...",
/// whose steps are taken in order. Fails for any other command.
RadianceXform parse_radiance_xform(const std::string& command, const RadiancePlace& place);

}  // namespace enfilade
