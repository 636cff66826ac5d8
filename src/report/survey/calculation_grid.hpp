// The calculation grid of EN 12464-1 (clause "Illuminance grid").
#pragma once

#include <vector>

#include "report/survey/room_plan.hpp"

namespace enfilade {

/// Returns the largest distance between grid points for an area with these sides, m: p = 0.2 *
/// 5^log10(d) and at most 10 m, where d is the longer side, or the shorter one where the longer is
/// at least twice as long.
double largest_spacing(double length_m, double width_m);

/// Returns the width of the band along walls that is left out: 0.5 m, or 15% of the shorter side of
/// the room where that is less.
double wall_zone(double length_m, double width_m);

struct CalculationGrid {
  double wall_zone_m = 0.0;
  double spacing_m = 0.0;  ///< the larger of the two
  PlanRectangle area;      ///< the rectangle around the room, less the wall zone
  int columns = 0, rows = 0;
  std::vector<Vec2> points;  ///< those in the room and outside its wall zone, row by row
  std::vector<int> cell;     ///< column + columns * row of each point
  std::size_t outside = 0;   ///< points of the rectangle that are not
};

/// Returns the grid of a room: the number of points along the side that counts is the whole number
/// nearest to d / p, and the spacing that this gives determines the number along the other side.
/// Points lie in the middles of the grid's cells. A room in which no point is left, as a narrow
/// ring may be, has a finer grid, or the point farthest from its walls. Empty where the room is.
CalculationGrid calculation_grid(const RoomPlan& room);

}  // namespace enfilade
