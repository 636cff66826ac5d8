#include "app/outputs/run_outputs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/outputs/plan_files.hpp"
#include "app/outputs/solved_run.hpp"
#include "app/outputs/walk_file.hpp"
#include "base/atomic_file.hpp"
#include "base/posix_file.hpp"
#include "report/export/solution_glb.hpp"
#include "report/export/surfaces_csv.hpp"
#include "report/pictures/picture_quality.hpp"
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
  record.set("extrapolation", summary.plan.extrapolation);
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
    if constexpr (!is_list<decltype(access)>) record.set(figure.name, access(summary.figures));
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

constexpr const char* picture_list = "pictures/pictures.json";

/// The files whose checksums are kept beside those of the records.
std::vector<std::string> sealed_names(const RunOutputs& outputs, const Scene& scene) {
  std::vector<std::string> names{"surfaces.csv", "solution.glb", "report.html"};
  if (!scene.probes.empty()) names.emplace_back("probes.json");
  if (outputs.rooms) names.emplace_back("rooms.csv");
  if (outputs.pictures) names.emplace_back(picture_list);
  return names;
}

/// Writes the pictures and their list; returns their names in RUN.
std::vector<std::string> write_pictures(const std::string& run_directory,
                                        std::span<const Figure> pictures) {
  std::vector<std::string> names;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Figure& figure : pictures) {
    names.push_back("pictures/" + file_name_of(figure.name.empty() ? figure.caption : figure.name) +
                    ".png");
    write_file_atomically(run_directory + "/" + names.back(), figure.png);
    list.push_back({{"file", names.back()}, {"caption", figure.caption}});
  }
  write_file_atomically(run_directory + "/" + picture_list, list.dump(1) + "\n");
  return names;
}

/// The pictures that a solve has made of the committed iteration; none where it has made none.
std::vector<Figure> kept_pictures(const std::string& run_directory) {
  std::vector<Figure> pictures;
  if (!reports_are_whole(run_directory, std::vector<std::string>{picture_list})) return pictures;
  const std::optional<std::string> list = read_report(run_directory, picture_list);
  for (const auto& entry : nlohmann::json::parse(list.value_or("[]"))) {
    const std::optional<std::string> png = read_report(run_directory, entry.at("file"));
    if (png) pictures.push_back({entry.at("caption"), *png, ""});
  }
  return pictures;
}

}  // namespace

std::string history_json(std::span<const IterationSummary> history) {
  std::string rows;
  for (const IterationSummary& summary : history) {
    rows += (rows.empty() ? "" : ",\n") + to_json(record_of(summary));
  }
  return "[" + rows + "]\n";
}

RunPage make_run_page(const RunOutputs& outputs, const SolvedRun& run, RunRooms& rooms,
                      const Progress& progress) {
  const SolvedScene solved = run.solved_scene();
  RunPage page = read_run_page(outputs.run_directory);
  std::vector<Figure> kept;
  if (outputs.pictures) kept = kept_pictures(outputs.run_directory);
  std::vector<Camera> cameras;
  if (outputs.pictures && kept.empty()) cameras = room_cameras(solved, rooms.all(), rooms.views());
  add_pictures(page, solved, cameras, read_owners(outputs.run_directory),
               picture_quality(page.stats.number("target_error", 0.0)), progress);
  if (!kept.empty()) page.pictures = std::move(kept);
  if (outputs.rooms)
    page.rooms = survey_run(run, rooms, {.survey = {.cylindrical = false}}, {}, progress);
  return page;
}

bool has_run_outputs(const RunOutputs& outputs, const Scene& scene) {
  const bool walk = !outputs.walk || !walk_program() ||
                    std::filesystem::exists(outputs.run_directory + "/walk.html");
  return walk && reports_are_whole(outputs.run_directory, sealed_names(outputs, scene));
}

bool write_walk_page(const RunOutputs& outputs, const SolvedRun& run, RunRooms& rooms,
                     const RoomTable* table) {
  const auto program = outputs.walk ? walk_program() : std::nullopt;
  if (!program) return false;
  write_file_atomically(outputs.run_directory + "/walk.html",
                        walk_page(run, rooms, outputs.run_directory, table, *program));
  return true;
}

void remove_run_outputs(const std::string& run_directory) {
  const std::filesystem::path run(run_directory);
  for (const char* name :
       {"stats.json", "reports.json", "history.json", "warnings.json", "assignment.json",
        "probes.json", "rooms.csv", "surfaces.csv", "solution.glb", "report.html", "walk.html",
        "trace.paje", "pictures", "shares"}) {
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
  RunRooms rooms(run);
  RunPage page = make_run_page(outputs, run, rooms, progress);
  std::vector<std::string> sealed = sealed_names(outputs, solved.scene);
  if (outputs.pictures) {
    write_run_plans(outputs.run_directory, page.plans);
    for (std::string& name : write_pictures(outputs.run_directory, page.pictures))
      sealed.push_back(std::move(name));
  }
  if (outputs.rooms) write_file_atomically(directory + "rooms.csv", rooms_csv(page.rooms));
  if (write_walk_page(outputs, run, rooms, outputs.rooms ? &page.rooms : nullptr))
    page.walk = "walk.html";
  write_file_atomically(directory + "report.html", report_html(std::span(&page, 1)));
  seal_reports(outputs.run_directory, sealed);
}

}  // namespace enfilade
