#include "run/leak_file.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/error.hpp"
#include "json/sealed_json.hpp"

namespace enfilade {
namespace {

constexpr const char* file_name = "leaks.json";

LeakKind kind_of(const std::string& name) {
  for (const LeakKind kind : {LeakKind::gap, LeakKind::open_side, LeakKind::lost_room}) {
    if (name == name_of(kind)) return kind;
  }
  throw RunError("leaks: unknown kind");
}

}  // namespace

void write_leaks(const std::string& run_directory, const std::vector<Leak>& leaks, RunMark& mark) {
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
  keep_prepared_file(run_directory, file_name,
                     nlohmann::ordered_json{{"leaks", std::move(list)}}.dump() + "\n", mark);
}

std::vector<Leak> read_leaks(const std::string& run_directory) {
  std::vector<Leak> leaks;
  const std::optional<RunMark> mark = read_run_mark(run_directory);
  if (!mark || !mark->prepared) return leaks;
  const std::string text = read_prepared_file(run_directory, file_name, *mark);
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    for (const auto& item : json.at("leaks")) {
      Leak leak{kind_of(item.at("kind")),
                CellId(whole<std::uint32_t>(item.at("cell"))),
                item.at("area_m2"),
                item.at("width_m"),
                {}};
      for (const auto& p : item.at("path")) leak.path.emplace_back(p.at(0), p.at(1), p.at(2));
      leaks.push_back(std::move(leak));
    }
  } catch (const nlohmann::json::exception&) {
    throw RunError(run_directory + "/" + file_name + ": holds no leaks; prepare the run again");
  } catch (const std::out_of_range&) {
    throw RunError(run_directory + "/" + file_name +
                   ": holds a cell that is none; prepare the run again");
  }
  return leaks;
}

}  // namespace enfilade
