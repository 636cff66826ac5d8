// The walk-through page of a solved run.
#pragma once

#include <string>

#include "app/outputs/room_survey.hpp"
#include "report/walk/walk_page.hpp"

namespace enfilade {

/// Returns walk.html, made with walk_program(), with the shares of the light that the run has, so
/// that lamps can be dimmed. `table` may be null, or is what survey_run() gave of `rooms`.
std::string walk_page(const SolvedRun& run, RunRooms& rooms, const std::string& run_directory,
                      const RoomTable* table, const std::string& program);

}  // namespace enfilade
