#include "app/outputs/room_survey.hpp"

#include "report/pictures/one_value.hpp"
#include "scene/daylight.hpp"

namespace enfilade {
namespace {

void set_outside(const Scene& scene, RoomTable& table) {
  const LightOutside outside = light_outside(scene);
  if (!outside.horizontal.empty()) {
    table.outside = one_value(scene, outside.horizontal);
  } else if (scene.sky) {
    table.no_daylight_factor = outside.obstacle + "; " + outside.remedy;
  }
}

std::vector<SurveyRoom> rooms_of_run(const SolvedRun& run) {
  const Scene& scene = run.prepared().scene;
  std::vector<SurveyRoom> rooms =
      rooms_of_building(run.solved_scene().building(), scene.building.rooms);
  if (scene.unit != ExitanceUnit::lumen_per_m2) {
    for (SurveyRoom& room : rooms) room.required = 0.0;
  }
  return rooms;
}

}  // namespace

std::span<const SurveyRoom> RunRooms::all() {
  if (!rooms_) rooms_ = rooms_of_run(run_);
  return *rooms_;
}

std::span<const std::optional<RoomView>> RunRooms::views() {
  if (!views_) views_ = standing_views(run_.solved_scene(), all());
  return *views_;
}

RoomTable survey_run(const SolvedRun& run, RunRooms& rooms, const RunSurvey& how,
                     std::span<const GlarePlace> places, const Progress& progress) {
  const Scene& scene = run.prepared().scene;
  const SolvedScene solved = run.solved_scene();
  const SurveyConfig& config = how.survey;
  const PointGather gather = run.gather_with(how.gather);
  const SurveyedScene surveyed{solved, gather, run.patch_error()};
  RoomTable table;
  table.unit = irradiance_label(scene.unit);
  table.weights = weights_of(scene);
  table.maintenance_factor = config.maintenance_factor;
  table.plane_m = config.plane_m;
  table.cylindrical_m = config.cylindrical_m;
  set_outside(scene, table);
  const std::span<const SurveyRoom> all = rooms.all();
  table.rooms = survey_rooms(surveyed, {all.begin(), all.end()}, config, progress);
  table.glare = glare_at(surveyed, places, config.maintenance_factor, progress);
  return table;
}

}  // namespace enfilade
