// Where a person would stand to see a room: for pictures and for the walk-through.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "report/pictures/camera.hpp"
#include "report/survey/building_rooms.hpp"

namespace enfilade {

/// A view, and the mean light of what lies ahead at eye height (one_value.hpp).
struct RoomView {
  Camera camera;
  double light = 0.0;
};

/// Returns a view from within the room at eye height (at most 0.6 of the room's height), from a
/// place that is open, over the room's own floor and free to all sides, along the room's longest
/// view. None where there is no such place. Deterministic.
std::optional<RoomView> standing_view(const SolvedScene& solved, const SurveyRoom& room,
                                      double eye_height_m = 1.6);

/// Returns standing_view() of each room.
std::vector<std::optional<RoomView>> standing_views(const SolvedScene& solved,
                                                    std::span<const SurveyRoom> rooms,
                                                    double eye_height_m = 1.6);

/// Returns which rooms are worth a picture, largest first: those with a view, a ceiling, and light
/// ahead that is more than a fiftieth of the brightest room's.
std::vector<std::size_t> rooms_to_show(std::span<const SurveyRoom> rooms,
                                       std::span<const std::optional<RoomView>> views);

/// Returns cameras at the `views` from within the largest rooms that are lit (config.inside of
/// them, largest first, "room-1", "room-2"...), then the cut-aways of automatic_cameras. Where no
/// room has a place to stand, all are those of automatic_cameras.
std::vector<Camera> room_cameras(const SolvedScene& solved, std::span<const SurveyRoom> rooms,
                                 std::span<const std::optional<RoomView>> views,
                                 const AutoCameraConfig& config = {});

}  // namespace enfilade
