#include "run/leak_file.hpp"

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

}  // namespace enfilade
