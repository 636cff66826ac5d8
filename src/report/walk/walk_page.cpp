#include "report/walk/walk_page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/safe_text.hpp"
#include "report/drawing/charts.hpp"
#include "report/pictures/false_colour.hpp"
#include "report/pictures/one_value.hpp"
#include "report/pictures/scene_tone.hpp"
#include "report/walk/walk_arrays.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t colours = 32;
/// Points of a floor whose patches are read for a room that has not been surveyed.
constexpr std::size_t floor_points = 64;
constexpr double marker_shift_m = 0.05;

Json point(const Vec3& p) { return {p.x, p.y, p.z}; }

/// Places and figures in the page are rounded to a tenth of a millimetre.
double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Json rings_of(const RoomPlan& plan, const Vec3& centre) {
  Json rings = Json::array();
  for (const auto& ring : plan.rings()) {
    Json& corners = rings.emplace_back(Json::array());
    for (const Vec2& p : ring) {
      corners.push_back(rounded(p.x - centre.x));
      corners.push_back(rounded(p.y - centre.y));
    }
  }
  return rings;
}

/// The mean irradiance of the floor, read off its patches at points spread evenly; none where no
/// ray from above meets a front.
std::optional<double> floor_light(const SolvedScene& solved, const SurveyRoom& room) {
  double sum = 0.0;
  int found = 0;
  for (const Vec2& p : room.plan.spread(floor_points)) {
    const Vec3 from(p, room.floor_m + 0.1 * room.height_m());
    const RayHit hit = solved.occluders.rays().closest(from, Vec3(0, 0, -1));
    if (!hit.any() || !hit.front) continue;
    const PolygonRef ref = solved.occluders.local(hit.polygon);
    const PatchForest& forest = solved.states[ref.cluster.index()].patches();
    Spectrum e(static_cast<std::size_t>(forest.bands()));
    forest.evaluate(false, ref.polygon, from - Vec3(0, 0, hit.distance_m), e);
    sum += one_value(solved.scene, e);
    ++found;
  }
  if (found == 0) return std::nullopt;
  return sum / found;
}

void add_figures(const RoomFigures& figures, Json& json) {
  if (figures.mean) json["mean"] = figures.mean->value;
  if (figures.minimum) json["minimum"] = figures.minimum->value;
  if (figures.u0) json["u0"] = figures.u0->value;
  if (figures.room.required > 0.0) json["required"] = figures.room.required;
  json["verdict"] = name_of(verdict_of(figures));
}

Json room_json(const WalkSubject& subject, std::size_t i, const WalkStoreys& storeys,
               const Vec3& centre) {
  const SurveyRoom& room = subject.rooms[i];
  Json json = {{"name", room.name},
               {"longName", room.long_name},
               {"storey", storeys.of(room)},
               {"area", rounded(room.area_m2)},
               {"floor", rounded(room.floor_m - centre.z)},
               {"height", rounded(room.height_m())},
               {"rings", rings_of(room.plan, centre)}};
  if (const std::optional<double> e = floor_light(subject.solved, room)) json["floorLight"] = *e;
  if (subject.table != nullptr) add_figures(subject.table->rooms[i], json);
  if (const std::optional<RoomView>& view = subject.views[i]) {
    json["eye"] = point(view->camera.eye - centre);
    json["look"] = point(view->camera.look_at - view->camera.eye);
  }
  return json;
}

Json palette() {
  Json list = Json::array();
  for (std::size_t i = 0; i < colours; ++i) {
    const Rgb8 c = scale_colour(static_cast<double>(i) / (colours - 1));
    list.push_back({c[0], c[1], c[2]});
  }
  return list;
}

/// The lights that have no surface in the building, each with 1 + the number of its share, or 0.
/// Markers stand a little before the place of one that shines one way, out of its ceiling.
Json lights_json(const WalkSubject& subject, const WalkStoreys& storeys, const Vec3& centre) {
  Json list = Json::array();
  const std::vector<LightSource>& lights = subject.solved.scene.lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightSource& light = lights[i];
    const bool of_surface = !light.opening.empty() && light.shape.shape == OpeningShape::point;
    if (light.is_far() || of_surface) continue;
    const bool one_way = light.distribution || light.cone;
    const Vec3 at = light.p + (one_way ? marker_shift_m : 0.0) * light.frame.aim - centre;
    const auto& share = subject.shares.of_light;
    const bool shared = i < share.size() && share[i] < subject.shares.names.size();
    list.push_back({{"name", light.name},
                    {"p", {rounded(at.x), rounded(at.y), rounded(at.z)}},
                    {"storey", storeys.of(light.p)},
                    {"share", shared ? share[i] + 1 : 0}});
  }
  return list;
}

Json model_json(const WalkSubject& subject, const WalkArrays& arrays, const LightChannels& channels,
                const WalkStoreys& storeys) {
  const Scene& scene = subject.solved.scene;
  const ToneMap tone = scene_tone_map(subject.solved);
  Json json = {{"title", subject.title},
               {"unit", irradiance_label(scene.unit)},
               {"lumens", scene.unit == ExitanceUnit::lumen_per_m2},
               {"channels", channels.count()},
               {"weights", channels.weights()},
               {"patchError", subject.patch_error},
               {"centre", point(arrays.centre)},
               {"scale", arrays.scale},
               {"polygons", arrays.polygons},
               {"faces", arrays.faces},
               {"corners", arrays.corners},
               {"exposure", tone.exposure()},
               {"white", tone.white()},
               {"palette", palette()},
               {"arrays", arrays.arrays.list()}};
  json["storeys"] = Json::array();
  for (const WalkStorey& storey : storeys.all()) {
    json["storeys"].push_back({{"name", storey.name},
                               {"floor", rounded(storey.floor_m - arrays.centre.z)},
                               {"cut", rounded(storey.cut_m - arrays.centre.z)}});
  }
  json["surveyed"] = subject.table != nullptr;
  if (subject.table != nullptr) json["plane"] = subject.table->plane_m;
  json["rooms"] = Json::array();
  for (std::size_t i = 0; i < subject.rooms.size(); ++i)
    json["rooms"].push_back(room_json(subject, i, storeys, arrays.centre));
  const std::vector<std::size_t> shown = rooms_to_show(subject.rooms, subject.views);
  json["start"] = shown.empty() ? -1 : static_cast<int>(shown.front());
  json["shares"] = Json::array();
  for (std::size_t i = 0; i < subject.shares.names.size(); ++i)
    json["shares"].push_back({{"name", subject.shares.names[i]}, {"scale", arrays.scales[i]}});
  json["lights"] = lights_json(subject, storeys, arrays.centre);
  return json;
}

/// Makes each text of it one that does nothing to whoever shows it.
void make_safe(Json& json) {
  if (json.is_string()) json = file_text(json.get_ref<const std::string&>());
  if (!json.is_structured()) return;
  for (Json& part : json) make_safe(part);
}

/// JSON in which nothing ends the element of the page that holds it.
std::string in_page(Json json) {
  make_safe(json);
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

void replace(std::string& page, const std::string& mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  if (at != std::string::npos) page.replace(at, mark.size(), text);
}

}  // namespace

std::string walk_html(const WalkSubject& subject, const std::string& program) {
  const LightChannels channels(subject.solved.scene);
  const WalkStoreys storeys(subject.solved, subject.rooms);
  const WalkArrays arrays = walk_arrays(subject.solved, channels, storeys, subject.shares);
  std::string page = program;
  // The data last: nothing in it is taken for a mark.
  replace(page, "<!--title-->", escaped(subject.title));
  replace(page, "<!--model-->", in_page(model_json(subject, arrays, channels, storeys)));
  replace(page, "<!--data-->", arrays.arrays.text());
  return page;
}

std::optional<std::string> walk_program() {
  std::error_code code;
  const fs::path executable = fs::read_symlink("/proc/self/exe", code);
  const fs::path installed =
      executable.parent_path().parent_path() / ENFILADE_WALK_INSTALLED / "walk.html";
  const bool beside = !code && fs::exists(installed, code);
  std::ifstream file(beside ? installed : fs::path(ENFILADE_WALK_BUILT "/walk.html"),
                     std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace enfilade
