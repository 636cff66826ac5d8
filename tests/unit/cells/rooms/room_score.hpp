// Cells held against a building's own list of rooms, doors and windows.
#pragma once

#include <string>
#include <vector>

#include "cells/partition/cell_complex.hpp"

namespace enfilade {

/// A room or an opening of the building's own data.
struct KnownBox {
  std::string name;
  Box box;
};

struct KnownBuilding {
  std::vector<KnownBox> rooms;
  std::vector<KnownBox> doors;
};

/// The `rooms`, and the doors among the `portals`, of a scene file.
KnownBuilding read_known_building(const std::string& scene_file);

struct RoomScore {
  struct Room {
    std::string name;
    CellId cell;       ///< its own, or none
    double iou = 0.0;  ///< overlap in volume over union with that cell
  };
  struct Door {
    std::string name;
    CellId a, b;  ///< the cells on its two sides
    bool right = false;
  };
  std::vector<Room> rooms;
  std::vector<Door> doors;

  double rooms_share() const;  ///< of rooms with an IoU of at least 0.5
  double doors_share() const;  ///< on a portal between the right two cells
};

/// Points of a grid of `step_m` are rooms' (where boxes overlap: the smallest one's) and cells';
/// every room gets the cell that overlaps it best, one room a cell. `move` takes the building's
/// points to where the complex has them.
RoomScore score_rooms(
    const KnownBuilding& building, const CellComplex& complex, double step_m,
    Vec3 (*move)(const Vec3&) = [](const Vec3& p) { return p; });

}  // namespace enfilade
