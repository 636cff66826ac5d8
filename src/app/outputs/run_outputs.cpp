#include "app/outputs/run_outputs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/outputs/plan_files.hpp"
#include "app/outputs/solved_run.hpp"
#include "base/atomic_file.hpp"
#include "base/posix_file.hpp"
#include "report/export/solution_glb.hpp"
#include "report/export/surfaces_csv.hpp"
#include "report/pictures/camera.hpp"
#include "run/sealed_reports.hpp"
#include "run/stats_json.hpp"
#include "scene_file/scene_io.hpp"
#include "solver/error_estimate.hpp"

namespace enfilade {

namespace {

RunRecord record_of(const IterationSummary& summary) {
  RunRecord record;
  record.set("iteration", summary.plan.iteration);
  record.set("refine", summary.plan.refine);
  record.set("link_tolerance", summary.plan.link_tolerance);
  record.set("estimated_error", summary.error.total());
  record.set("estimated_discretisation_error", summary.error.discretisation);
  record.set("estimated_visibility_error", summary.error.visibility);
  record.set("estimated_iteration_error", summary.error.iteration);
  record.set("estimated_patch_error", summary.error.patches);
  record.set("iteration_error_bound", summary.error.iteration_bound);
  record.set("correction_failed", summary.correction_failed);
  record.set("sampled", summary.plan.sample);
  if (summary.plan.sample) record.set("sample_noise", sample_noise(summary.figures.error_samples));
  record.set("relative_change", summary.figures.received_power > 0.0
                                    ? summary.figures.change_power / summary.figures.received_power
                                    : 0.0);
  for_each_figure([&](const FigureName& figure, auto access) {
    if constexpr (!is_spectrum<decltype(access)>) record.set(figure.name, access(summary.figures));
  });
  record.set("time_s", summary.time_s);
  return record;
}

void write_records(const std::string& run_directory, const RunRecords& records) {
  const std::string run = run_directory + "/";
  write_stats(records.stats, run + "stats.json");
  write_file_atomically(run + "history.json", history_json(records.history));
  write_file_atomically(run + "warnings.json",
                        nlohmann::json(records.warnings.summary()).dump(1) + "\n");
  std::vector<int> ranks;
  for (const Rank rank : records.owner) ranks.push_back(rank.value);
  write_file_atomically(run + "assignment.json", nlohmann::json(ranks).dump() + "\n");
  seal_reports(run_directory);
}

/// "View from room 3, false colour" -> "view-from-room-3-false-colour".
std::string file_name_of(const std::string& caption) {
  std::string name;
  for (const char c : caption) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z');
    if (plain)
      name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "picture" : name;
}

}  // namespace

std::string history_json(std::span<const IterationSummary> history) {
  std::string rows;
  for (const IterationSummary& summary : history) {
    rows += (rows.empty() ? "" : ",\n") + to_json(record_of(summary));
  }
  return "[" + rows + "]\n";
}

RunPage make_run_page(const std::string& run_directory, const SolvedScene& solved, bool pictures,
                      const Progress& progress) {
  RunPage page = read_run_page(run_directory);
  std::vector<Camera> cameras;
  if (pictures) cameras = automatic_cameras(solved);
  const std::vector<Rank> owner = read_owners(run_directory);
  add_pictures(page, solved, cameras, owner, {}, progress);
  return page;
}

void remove_run_outputs(const std::string& run_directory) {
  const std::filesystem::path run(run_directory);
  for (const char* name :
       {"stats.json", "reports.json", "history.json", "warnings.json", "assignment.json",
        "probes.json", "surfaces.csv", "solution.glb", "report.html", "trace.paje", "pictures"}) {
    remove_directory((run / name).string());
  }
}

void write_run_outputs(const RunOutputs& outputs, RunRecords records, const Progress& progress) {
  const std::string directory = outputs.run_directory + "/";
  write_records(outputs.run_directory, records);
  const SolvedRun run(std::move(records.prepared), outputs.run_directory);
  const SolvedScene solved = run.solved_scene();
  write_file_atomically(directory + "surfaces.csv", surfaces_csv(solved));
  write_file_atomically(directory + "solution.glb", solution_glb(solved));
  if (const auto& probes = solved.scene.probes; !probes.empty()) {
    // The run's own copy of the scene counts: the file that was given may be another by now.
    write_probe_answers(
        {directory + "scene.json", scene_text(outputs.run_directory), solved.scene.probes},
        directory + "probes.json",
        irradiance_at(run, probes, ProbeMethod::gather, progress).answers, "gather",
        solved.scene.unit);
  }
  const RunPage page = make_run_page(outputs.run_directory, solved, outputs.pictures, progress);
  if (outputs.pictures) write_run_plans(outputs.run_directory, page.plans);
  for (const Figure& figure : page.pictures) {
    write_file_atomically(directory + "pictures/" + file_name_of(figure.caption) + ".png",
                          figure.png);
  }
  write_file_atomically(directory + "report.html", report_html(std::span(&page, 1)));
}

}  // namespace enfilade
