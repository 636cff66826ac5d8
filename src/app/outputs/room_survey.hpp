// The table of a solved run's rooms.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "app/outputs/solved_run.hpp"
#include "report/room_table/room_table.hpp"
#include "report/survey/room_cameras.hpp"

namespace enfilade {

/// What a survey does, and its rays: a room's figures are of many points, so that each needs fewer
/// than a probe.
struct RunSurvey {
  SurveyConfig survey;
  PointGatherConfig gather{.rays = 256, .noise = 0.02};
};

/// The rooms of the run's scene, or its cells where it names none, and where one stands in them:
/// found when they are first asked for, and once for all that show them. What rooms ask for in lux
/// counts only where the scene's light is in lumens. Refers to the run. One thread's alone.
class RunRooms {
 public:
  explicit RunRooms(const SolvedRun& run) : run_(run) {}
  std::span<const SurveyRoom> all();
  std::span<const std::optional<RoomView>> views();

 private:
  const SolvedRun& run_;
  std::optional<std::vector<SurveyRoom>> rooms_;
  std::optional<std::vector<std::optional<RoomView>>> views_;
};

/// Surveys the run's rooms and the glare at `places`.
RoomTable survey_run(const SolvedRun& run, RunRooms& rooms, const RunSurvey& config,
                     std::span<const GlarePlace> places = {}, const Progress& progress = {});

}  // namespace enfilade
