// report.html: one self-contained page about one run or several.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "base/run_record.hpp"
#include "report/pictures/camera.hpp"
#include "report/pictures/render.hpp"
#include "report/plans/floor_plan.hpp"
#include "report/room_table/room_table.hpp"

namespace enfilade {

/// A PNG picture with its caption.
struct Figure {
  std::string caption;
  std::string png;
  std::string name{};  ///< of its file, without ending; empty: from the caption
};

/// The data that the page shows about one run.
struct RunPage {
  std::string name;
  RunRecord stats;
  std::vector<RunRecord> history;  ///< one per iteration
  std::vector<Figure> pictures;
  std::vector<FloorPlan> plans;
  RoomTable rooms;       ///< comes first; without rooms where it was not asked for
  std::string walk;      ///< address of the run's walk-through; empty where there is none
  std::string timeline;  ///< SVG of the ranks' phases; empty where the run kept no trace
  std::vector<std::string> warnings, attribution;
};

/// Reads RUN's stats.json, history.json, warnings.json and scene.json (its licence); no pictures
/// yet. Throws InputError where RUN has no stats.json.
RunPage read_run_page(const std::string& run_directory);
/// Returns plans of each storey's cells and, where there are several ranks, of the assignment.
/// `owner` may be empty.
std::vector<FloorPlan> plans_of_run(const PlannedBuilding& building, std::span<const Rank> owner);
/// Renders the pictures (tone-mapped; the first from within and the first cut-away also in false
/// colour) and draws the plans.
void add_pictures(RunPage& page, const SolvedScene& solved, std::span<const Camera> cameras,
                  std::span<const Rank> owner, const RenderConfig& config,
                  const Progress& progress = {});

/// Returns a page with a body in the style of the report (HTML), its title as text.
std::string html_page(const std::string& title, const std::string& body);

/// Returns the page. With several runs a table that compares them comes first.
std::string report_html(std::span<const RunPage> runs);

}  // namespace enfilade
