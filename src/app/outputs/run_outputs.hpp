// The files for people that a solve writes into RUN/, beside the solution itself.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/outputs/room_survey.hpp"
#include "app/outputs/solved_run.hpp"
#include "base/progress.hpp"
#include "base/run_record.hpp"
#include "base/warnings.hpp"
#include "report/page/html_report.hpp"
#include "run/prepare.hpp"
#include "solver/iteration_plan.hpp"

namespace enfilade {

struct RunOutputs {
  std::string run_directory;
  bool pictures = true;
  bool rooms = false;  ///< rooms.csv, and the table of rooms in report.html
  bool walk = true;    ///< walk.html, where the build has made its program
};

/// Results of the solve that are in memory.
struct RunRecords {
  Prepared prepared;
  RunRecord stats;
  std::vector<IterationSummary> history;
  std::vector<Rank> owner;  ///< rank that each cluster was assigned to
  Warnings warnings;
};

/// Returns the file history.json: one record per iteration.
std::string history_json(std::span<const IterationSummary> history);

/// Removes the files that an earlier solve wrote, so that none of them stands beside a new
/// solution. Throws RunError where one cannot be removed.
void remove_run_outputs(const std::string& run_directory);

/// stats.json, history.json, warnings.json and assignment.json; surfaces.csv, solution.glb,
/// report.html, walk.html; probes.json where the scene has probes; and pictures/, a file each, with
/// their list in pictures/pictures.json. Takes `records.prepared` over.
void write_run_outputs(const RunOutputs& outputs, RunRecords records, const Progress& progress);

/// Writes RUN/walk.html, with the shares of the light that the run has; false where it is not asked
/// for, or the build has no program for it. `table` may be null.
bool write_walk_page(const RunOutputs& outputs, const SolvedRun& run, RunRooms& rooms,
                     const RoomTable* table);

/// True where RUN has all these files, as a solve has written them for the committed iteration.
bool has_run_outputs(const RunOutputs& outputs, const Scene& scene);

/// Returns the page of a run that has a solution: with plans, with pictures and the table of rooms
/// where `outputs` asks for them. Pictures that the solve has made are taken as they are.
RunPage make_run_page(const RunOutputs& outputs, const SolvedRun& run, RunRooms& rooms,
                      const Progress& progress);

}  // namespace enfilade
