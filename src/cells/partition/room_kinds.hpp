// Which groups of leaves are rooms, and which the insides of walls, floors and furniture.
#pragma once

#include <vector>

#include "cells/partition/leaf_graph.hpp"

namespace enfilade {

struct RoomConfig {
  /// Thinner (by its mean chord, 4 V / S) than this share of the typical room, a cell is a room
  /// (a closet, a passage) only where it is not much smaller...
  double thin_share = 0.75;
  double closet_share = 0.02;
  /// ... and has a door: an opening to a room of this share of its face there, and of V^(2/3). Else
  /// it is the inside of a wall, a floor or a cupboard.
  double door_share = 0.1;
};

/// By group: a room, or the outside.
std::vector<char> find_rooms(const LeafGraph& graph, const RoomConfig& config);

/// Half of all volume that is no solid lies in groups of at least this volume, m3.
double typical_volume_m3(const LeafGraph& graph);

}  // namespace enfilade
