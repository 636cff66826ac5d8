// The distinct planes that a scene's pieces lie in, found by hashing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/convex.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// The planes, and by piece its plane's index and whether the piece faces the plane's front. Every
/// vertex of a piece lies within the tolerance of its plane.
struct PlaneSet {
  std::vector<Plane> planes;
  std::vector<std::uint32_t> plane_of_piece;
  std::vector<char> same_facing;
};

PlaneSet find_planes(std::span<const Piece> pieces, double tolerance_m);

/// Returns the orthonormal frame that most of the surface area is aligned to: a turned building
/// gets a turned frame. The first axis is at right angles to most floors.
Frame dominant_frame(std::span<const Piece> pieces);

}  // namespace enfilade
