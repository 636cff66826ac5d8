// Which pieces are covered by others that lie in the same plane and face the same way.
#pragma once

#include <vector>

#include "scene/scene_scale.hpp"

namespace enfilade {

/// How much of each piece is covered.
struct Covered {
  std::vector<double> area_m2;  ///< per piece
  std::vector<bool> duplicate;  ///< per piece: the same outline and material as an earlier one
};

/// Cuts away the covered parts; `pieces` become the remaining parts, in the old order. The emitting
/// surface is in front, else the later one of the file; of two that are the same in outline and
/// material the earlier stays.
///
/// Polygons that face opposite ways are never cut. Where two such coincide, nothing in the two
/// alone tells a wall without thickness (both must stay, or light leaks) from two solids in contact
/// (cutting would be allowed, but what is left is enclosed by the solids, where no light can
/// reach it).
Covered cut_covered(std::vector<Piece>& pieces, const Scene& scene, const SceneScale& scale);

}  // namespace enfilade
