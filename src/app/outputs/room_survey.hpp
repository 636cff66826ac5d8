// The table of a solved run's rooms.
#pragma once

#include <span>

#include "app/outputs/solved_run.hpp"
#include "report/room_table/room_table.hpp"

namespace enfilade {

/// What a survey does, and its rays: a room's figures are of many points, so that each needs fewer
/// than a probe.
struct RunSurvey {
  SurveyConfig survey;
  PointGatherConfig gather{.rays = 256, .noise = 0.02};
};

/// Returns the rooms of the run's scene, or its cells where it names none. What rooms ask for in
/// lux counts only where the scene's light is in lumens.
std::vector<SurveyRoom> rooms_of_run(const SolvedRun& run);

/// Surveys rooms_of_run() and the glare at `places`.
RoomTable survey_run(const SolvedRun& run, const RunSurvey& config,
                     std::span<const GlarePlace> places = {}, const Progress& progress = {});

}  // namespace enfilade
