#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/error.hpp"
#include "report/page/html_report.hpp"
#include "report/pictures/false_colour.hpp"
#include "report/pictures/tone_mapping.hpp"
#include "run/prepare.hpp"
#include "run/sealed_reports.hpp"
#include "run/stats_json.hpp"

namespace enfilade {

RunPage read_run_page(const std::string& run_directory) {
  const std::filesystem::path run(run_directory);
  RunPage page;
  page.name = run.lexically_normal().filename().string();
  if (page.name.empty() || page.name == ".")
    page.name = run.lexically_normal().parent_path().filename().string();
  page.stats = read_stats(run_directory);
  if (page.stats.entries().empty()) {
    throw InputError(run_directory, "stats.json", "there is none",
                     "give a run directory that a solve has written");
  }
  page.history = read_history(run_directory);
  page.warnings = read_warnings(run_directory);
  page.timeline = read_report(run_directory, "pictures/ranks.svg").value_or("");
  page.attribution = read_attribution(scene_text(run_directory));
  return page;
}

std::vector<FloorPlan> plans_of_run(const PlannedBuilding& building, std::span<const Rank> owner) {
  std::vector<FloorPlan> plans = floor_plans(building, cells_subject(building));
  const auto other = [&](const Rank& rank) { return rank != owner.front(); };
  if (owner.size() == building.clusters.size() && std::ranges::any_of(owner, other)) {
    for (FloorPlan& plan : floor_plans(building, assignment_subject(building, owner)))
      plans.push_back(std::move(plan));
  }
  return plans;
}

namespace {

/// With what tells the picture's quality.
std::string caption_of(const Camera& camera, const RenderConfig& config) {
  const std::string what = camera.title.empty() ? camera.name : camera.name + ": " + camera.title;
  if (config.gather_rays <= 0) return what + ", light of the patches";
  return fmt::format("{}, light gathered by {} rays every {} pixels", what, config.gather_rays,
                     config.gather_every_px);
}

}  // namespace

void add_pictures(RunPage& page, const SolvedScene& solved, std::span<const Camera> cameras,
                  std::span<const Rank> owner, const RenderConfig& config,
                  const Progress& progress) {
  const std::string unit = irradiance_label(solved.scene.unit);
  bool inside_shown = false, above_shown = false;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const Camera& camera = cameras[i];
    const LightImage image =
        render(solved, camera, config, [&](std::string_view phase, double done) {
          report_progress(progress, phase,
                          (static_cast<double>(i) + done) / static_cast<double>(cameras.size()));
        });
    const std::string caption = caption_of(camera, config);
    page.pictures.push_back({caption, encode_png(tone_mapped(image), caption), camera.name});
    bool& shown = camera.cut_above_m ? above_shown : inside_shown;
    if (!shown) {
      const std::string light = fmt::format("{}: irradiance, {}", camera.name, unit);
      page.pictures.push_back({light, encode_png(false_coloured(image, unit), light), ""});
    }
    shown = true;
  }
  page.plans = plans_of_run(solved.building(), owner);
}

}  // namespace enfilade
