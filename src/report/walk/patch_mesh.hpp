// The leaf patches of a polygon as faces that share their corners.
#pragma once

#include <cstdint>
#include <vector>

#include "hierarchy/patch_forest.hpp"

namespace enfilade {

/// Of one polygon. A face is a leaf patch; its corners run counter-clockwise about its centroid,
/// and among them are the corners of its neighbours that lie on its edges, so that faces meet
/// without gaps and light can run on from one to the next.
struct PatchMesh {
  std::vector<Vec2> points;  ///< in the polygon's frame, metres; each once
  struct Face {
    std::size_t node = 0;  ///< of the forest
    std::vector<std::uint32_t> corners;
  };
  std::vector<Face> faces;
};

/// `leaves` are the polygon's leaf patches. Points nearer than a micrometre are one.
PatchMesh patch_mesh(const PatchForest& forest, std::uint32_t polygon,
                     const std::vector<std::size_t>& leaves);

/// Returns the leaf patches of each polygon, in ascending order.
std::vector<std::vector<std::size_t>> leaves_by_polygon(const PatchForest& forest);

}  // namespace enfilade
