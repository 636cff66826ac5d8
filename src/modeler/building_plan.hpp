// The plan that all storeys share: the corridor's path cut into bays, each with its borders.
#pragma once

#include <array>
#include <vector>

#include "base/geometry.hpp"
#include "modeler/building.hpp"

namespace enfilade {

/// A line across the building; two neighbouring bays are mirror images of each other in it.
struct CrossLine {
  Vec2 at{0.0};          ///< on the corridor's centre line
  Vec2 ahead{1.0, 0.0};  ///< unit normal, along the path
};

enum class BayEnd { start, end };
enum class BaySide { left, right };

/// One chord of the path.
struct Bay {
  int index = 0;
  int wing = 0;
  Vec2 ahead{1.0, 0.0};  ///< unit
  Vec2 left{0.0, 1.0};   ///< unit
  CrossLine start, end;
  bool stairs = false;  ///< a stairwell in place of the left room

  /// Where the line that runs `to_left_m` beside the chord meets the parallel of a border that lies
  /// `ahead_m` further on.
  Vec2 meet(BayEnd at, double ahead_m, double to_left_m) const;
};

/// A room's floor: corners counter-clockwise, the first two at the corridor; y of its own frame
/// points away from the corridor, x to the right of who looks that way.
struct ModelRoom {
  std::array<Vec2, 4> corners;
  Vec2 x{1.0, 0.0}, y{0.0, 1.0};
  double width_m = 0.0;  ///< of the largest rectangle that stands on the corridor's wall
  double depth_m = 0.0;
  Vec2 origin{0.0};  ///< of that rectangle, at the corridor

  Vec2 world(double px, double py) const { return origin + px * x + py * y; }
};

struct BuildingPlan {
  std::vector<Bay> bays;
  std::vector<char> has_cross_wall;  ///< by border: bays + 1, of which the ends have one

  /// Of the building's outer face.
  double half_depth_m = 0.0;
};

/// Throws InputError where a wing bends too sharply for its rooms or the building runs into itself.
BuildingPlan plan_building(const Building& building);
ModelRoom plan_room(const Building& building, const Bay& bay, BaySide side);

}  // namespace enfilade
