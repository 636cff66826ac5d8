// A room's plan in false colour with isolux lines.
#pragma once

#include "report/drawing/drawing.hpp"
#include "report/survey/room_figures.hpp"

namespace enfilade {

/// Colours of light on a logarithmic scale between two values, in the table's unit.
struct LightScale {
  double lowest = 0.0, highest = 0.0;
  Rgb8 colour(double value) const;
};
/// Returns the scale that holds the values of all rooms, four decades at most; of equal ends where
/// there is no light.
LightScale scale_of(std::span<const RoomFigures> rooms);

/// Returns the plan of the room: its outline, the light of the grid's points in colours,
/// interpolated between them, and lines with their values. Points that do not count are left white.
Drawing room_drawing(const RoomFigures& room, const LightScale& scale, const std::string& unit);

}  // namespace enfilade
