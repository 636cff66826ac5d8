// The files for people that a solve writes into RUN/, beside the solution itself.
#pragma once

#include <span>
#include <string>
#include <vector>

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
/// report.html; probes.json where the scene has probes; and pictures/, a file each. Takes
/// `records.prepared` over.
void write_run_outputs(const RunOutputs& outputs, RunRecords records, const Progress& progress);

/// Returns the page of a run that has a solution: with plans, and with pictures where `pictures` is
/// true.
RunPage make_run_page(const std::string& run_directory, const SolvedScene& solved, bool pictures,
                      const Progress& progress);

}  // namespace enfilade
