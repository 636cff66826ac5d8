// The table of a building's rooms: as CSV, and as a part of an HTML page.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/survey/glare.hpp"
#include "report/survey/room_figures.hpp"

namespace enfilade {

struct RoomTable {
  std::vector<RoomFigures> rooms;
  std::vector<GlareRating> glare;  ///< at the places that were asked for
  std::string unit;                ///< "lx" or "W/m2"
  std::string weights;             ///< weights_of() the scene
  double maintenance_factor = 1.0;
  double plane_m = 0.75, cylindrical_m = 1.2;  ///< heights that were asked for
  /// On an unobstructed horizontal plane, which daylight factors refer to; 0 where the rooms' light
  /// is not that of a sky alone, and then why (light_outside()).
  double outside = 0.0;
  std::string no_daylight_factor{};
};

/// Returns light in the working plane as a daylight factor, percent; none where there is none.
std::optional<Estimate> daylight_factor(const RoomTable& table, const std::optional<Estimate>& e);

/// Returns the name of the room that p lies in; empty for none.
std::string room_at(std::span<const RoomFigures> rooms, const Vec3& p);

/// One line a room, in the table's unit. Columns: room, long_name, storey, area_m2, height_m,
/// points (of the grid, that count), points_in_furniture, points_without_floor, spacing_m,
/// wall_zone_m, plane_m, unit, mean, minimum, maximum, u0, error (of the mean, one standard
/// deviation, as are all
/// ..._error), minimum_error, maximum_error, u0_error, walls, walls_error, ceiling, ceiling_error,
/// cylindrical, cylindrical_error, daylight_factor_mean, daylight_factor_mean_error,
/// daylight_factor_minimum, daylight_factor_minimum_error, daylight_factor_median,
/// daylight_factor_median_error (percent), required, verdict, ugr (highest of the places in the
/// room), maintenance_factor, weights. A figure that is not known is an empty field.
std::string rooms_csv(const RoomTable& table);
/// One line a place: place, x, y, z, dx, dy, dz, room, ugr, ugr_error, background_cd_m2, sources,
/// largest_sr.
std::string glare_csv(const RoomTable& table);

/// The table, which a click on a column's head sorts, and a plan of each room in false colour with
/// isolux lines. For the body of a page with `report_style`; `id` begins the names of its anchors.
std::string rooms_html(const RoomTable& table, const std::string& id = "room");

}  // namespace enfilade
