#include "report/survey/calculation_grid.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

constexpr double most_spacing_m = 10.0;
constexpr double most_wall_zone_m = 0.5, wall_zone_share = 0.15;
/// A room in which no point is left gets a grid finer by a half, so many times.
constexpr int most_halvings = 4;
/// Points nearer than this to the edge of the wall zone count as outside of it.
constexpr double rounding = 1e-9;

/// The side that determines the spacing.
double governing_side(double length_m, double width_m) {
  const double longer = std::max(length_m, width_m), shorter = std::min(length_m, width_m);
  return longer >= 2.0 * shorter ? shorter : longer;
}

int count_for(double side_m, double spacing_m) {
  return std::max(1, static_cast<int>(std::lround(side_m / spacing_m)));
}

void fill(CalculationGrid& grid, const RoomPlan& room) {
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Vec2 p = grid.area.at((column + 0.5) / grid.columns * grid.area.length_m,
                                  (row + 0.5) / grid.rows * grid.area.width_m);
      if (room.contains(p) && room.distance_to_edge(p) >= grid.wall_zone_m * (1.0 - rounding)) {
        grid.points.push_back(p);
        grid.cell.push_back(column + grid.columns * row);
      } else {
        ++grid.outside;
      }
    }
  }
}

}  // namespace

double largest_spacing(double length_m, double width_m) {
  const double d = governing_side(length_m, width_m);
  return d > 0.0 ? std::min(most_spacing_m, 0.2 * std::pow(5.0, std::log10(d))) : 0.0;
}

double wall_zone(double length_m, double width_m) {
  return std::min(most_wall_zone_m, wall_zone_share * std::min(length_m, width_m));
}

CalculationGrid calculation_grid(const RoomPlan& room) {
  CalculationGrid grid;
  const PlanRectangle whole = room.rectangle();
  if (!(whole.length_m > 0.0 && whole.width_m > 0.0)) return grid;
  grid.wall_zone_m = wall_zone(whole.length_m, whole.width_m);
  grid.area = {whole.at(grid.wall_zone_m, grid.wall_zone_m), whole.along,
               whole.length_m - 2.0 * grid.wall_zone_m, whole.width_m - 2.0 * grid.wall_zone_m};
  const double side_m = governing_side(grid.area.length_m, grid.area.width_m);
  double spacing_m =
      side_m / count_for(side_m, largest_spacing(grid.area.length_m, grid.area.width_m));
  for (int halvings = 0; halvings <= most_halvings && grid.points.empty(); ++halvings) {
    grid.columns = count_for(grid.area.length_m, spacing_m);
    grid.rows = count_for(grid.area.width_m, spacing_m);
    grid.spacing_m = std::max(grid.area.length_m / grid.columns, grid.area.width_m / grid.rows);
    grid.outside = 0;
    fill(grid, room);
    spacing_m *= 0.5;
  }
  if (grid.points.empty()) {
    grid.points.push_back(room.middle());
    grid.cell.push_back(0);
    grid.area = whole;
    grid.columns = grid.rows = 1;
    grid.outside = 0;
  }
  return grid;
}

}  // namespace enfilade
