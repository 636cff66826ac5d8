// The polygons that Radiance's generators make.
#pragma once

#include <vector>

#include "geometry/polygon.hpp"
#include "import/radiance/radiance_text.hpp"

namespace enfilade {

/// What a generator was asked for.
struct RadianceGenerated {
  std::string modifier, name;
  std::vector<Polygon> polygons;
};

/// genbox's arguments: "modifier name x y z [-i] [-r radius | -b bevel]". Rounded and bevelled
/// edges are left sharp.
RadianceGenerated radiance_box(const std::vector<std::string>& words, const RadiancePlace& place);
/// genprism's: "modifier name N x1 y1 ... xN yN [-l x y z] [-c] [-e] [-r radius]".
RadianceGenerated radiance_prism(const std::vector<std::string>& words, const RadiancePlace& place);

}  // namespace enfilade
