#include "run/leak_file.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

std::string path_of(const std::string& run_directory) { return run_directory + "/leaks.json"; }

LeakKind kind_of(const std::string& name) {
  for (const LeakKind kind : {LeakKind::gap, LeakKind::open_side, LeakKind::lost_room}) {
    if (name == name_of(kind)) return kind;
  }
  throw RunError("leaks: unknown kind");
}

const char* what_of(LeakKind kind) {
  switch (kind) {
    case LeakKind::gap:
      return "light leaks out through a gap, path in leaks.json; close it if that is not meant";
    case LeakKind::open_side:
      return "a room is open to the outside as if a wall was missing, path in leaks.json; add the "
             "wall if there is one";
    case LeakKind::lost_room:
      break;
  }
  return "a room is so open that it is taken as outside, path in leaks.json; close its walls if it "
         "is a room";
}

/// Where the opening is, or the room.
std::string place_of(const Leak& leak) {
  const Vec3& p = leak.path.front();
  char text[160];
  if (leak.kind == LeakKind::lost_room) {
    std::snprintf(text, sizeof text, "at (%.10g, %.10g, %.10g)", p.x, p.y, p.z);
  } else {
    std::snprintf(text, sizeof text, "cell %u around (%.10g, %.10g, %.10g), %.3g m2, %.3g m wide",
                  leak.cell.value, p.x, p.y, p.z, leak.area_m2, leak.width_m);
  }
  return text;
}

}  // namespace

void write_leaks(const std::string& run_directory, const std::vector<Leak>& leaks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Leak& leak : leaks) {
    nlohmann::ordered_json path = nlohmann::ordered_json::array();
    for (const Vec3& p : leak.path) path.push_back({p.x, p.y, p.z});
    list.push_back({{"kind", name_of(leak.kind)},
                    {"cell", leak.cell.value},
                    {"area_m2", leak.area_m2},
                    {"width_m", leak.width_m},
                    {"path", std::move(path)}});
  }
  replace_file(path_of(run_directory),
               nlohmann::ordered_json{{"leaks", std::move(list)}}.dump() + "\n");
}

std::vector<Leak> read_leaks(const std::string& run_directory) {
  const std::string file = path_of(run_directory);
  std::vector<Leak> leaks;
  if (std::error_code code; !std::filesystem::exists(file, code)) return leaks;
  try {
    std::ifstream in(file);
    const nlohmann::json json = nlohmann::json::parse(in);
    for (const auto& item : json.at("leaks")) {
      Leak leak{kind_of(item.at("kind")),
                CellId(item.at("cell").get<std::uint32_t>()),
                item.at("area_m2"),
                item.at("width_m"),
                {}};
      for (const auto& p : item.at("path")) leak.path.emplace_back(p.at(0), p.at(1), p.at(2));
      leaks.push_back(std::move(leak));
    }
  } catch (const std::exception& error) {
    throw RunError(file + ": is damaged (" + error.what() + "); prepare the run again");
  }
  return leaks;
}

void warn_of_leaks(const std::vector<Leak>& leaks, Warnings& warnings) {
  for (const Leak& leak : leaks) warnings.add(place_of(leak), what_of(leak.kind));
}

}  // namespace enfilade
