// The surfaces of a building and their light as arrays, for walk.html.
#pragma once

#include <string>
#include <vector>

#include "report/pictures/solved_scene.hpp"
#include "report/walk/binary_arrays.hpp"
#include "report/walk/light_channels.hpp"
#include "report/walk/walk_storeys.hpp"

namespace enfilade {

/// What page/model.js reads, in this order. Places are relative to `centre`, metres; light is in
/// units of `scale`.
///   frames       9 a polygon, float: a point, then the axes u and v; the front looks along u x v
///   reflectance  a channel each a polygon, float
///   exitance     a channel each a polygon, float
///   storey       1 a polygon, 8 bits
///   outside      1 a polygon, 8 bits: 1 where its front looks into no room of the building
///   point_count  1 a polygon, 32 bits
///   face_count   1 a polygon, 32 bits
///   points       2 a point, float: along u and v
///   corner_count 1 a face, 16 bits
///   corners      1 a corner, 32 bits: its point, counted within the polygon
///   middles      2 a face, float: its centroid along u and v
///   light        for each face a channel each at each of its corners, then at its centroid; half
///                floats. The irradiance there by the face's own patch
///   lamp         1 a polygon, 16 bits, where there are shares: 0, or 1 + the share that it shines
///   by share_0...   for each share what `light` is for the whole, in units of scales[0...]
struct WalkArrays {
  std::vector<double> scales;
  BinaryArrays arrays;
  Vec3 centre{0.0};
  double scale = 1.0;
  std::size_t polygons = 0, faces = 0, corners = 0;
};

/// The light of each luminaire or switch: for each cluster the patches of the solution, with its
/// bands, then as many for each share (shares/share_scene.hpp). Without names there are none.
struct WalkShares {
  std::vector<std::string> names;
  std::span<const ClusterState> clusters;
  std::vector<std::size_t> of_light{};  ///< of each light of the scene; names.size() for none
};

WalkArrays walk_arrays(const SolvedScene& solved, const LightChannels& channels,
                       const WalkStoreys& storeys, const WalkShares& shares = {});

}  // namespace enfilade
