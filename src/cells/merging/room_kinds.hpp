// Which groups of leaves are rooms, and which the insides of walls, floors and furniture.
#pragma once

#include <vector>

#include "cells/merging/leaf_graph.hpp"

namespace enfilade {

struct RoomConfig {
  /// A group thinner (by its mean chord, 4 V / S) than this share of the typical room is a room (a
  /// closet, a passage) only where its volume is at least this share of a typical room's...
  double thin_share = 0.75;
  double closet_share = 0.02;
  /// ... and where it has a door: an opening to a room of this share of its face there, and of
  /// V^(2/3). Otherwise it is the inside of a wall, a floor or a cupboard.
  double door_share = 0.1;
};

/// Returns by group 1 for rooms and the outside, 0 for the insides of solids.
std::vector<char> find_rooms(const LeafGraph& graph, const RoomConfig& config);

/// Returns the volume-weighted median of the volumes of the groups that are not solid, m3.
double typical_volume_m3(const LeafGraph& graph);

}  // namespace enfilade
