#include "report/walk/walk_storeys.hpp"

#include <algorithm>
#include <map>

#include "report/plans/storeys.hpp"

namespace enfilade {
namespace {

/// Of a storey's headroom: rooms are cut this high.
constexpr double cut_share = 0.75;
/// A floor may lie this far below its storey's, as in a bathroom.
constexpr double step_share = 0.3;
/// Of the distance between floors: a cell that is higher spans several storeys.
constexpr double one_storey = 1.5;

}  // namespace

WalkStoreys::WalkStoreys(const SolvedScene& solved, std::span<const SurveyRoom> rooms)
    : cells_(solved.cells) {
  std::map<std::string, std::vector<const SurveyRoom*>> by_name;
  for (const SurveyRoom& room : rooms) by_name[room.storey].push_back(&room);
  for (auto& [name, own] : by_name) {
    // The floor and the ceiling of the middle of its area, by height of the floors.
    std::ranges::sort(own, {}, [](const SurveyRoom* room) { return room->floor_m; });
    double total_m2 = 0.0, below_m2 = 0.0;
    for (const SurveyRoom* room : own) total_m2 += room->area_m2;
    for (const SurveyRoom* room : own) {
      if ((below_m2 += room->area_m2) < 0.5 * total_m2) continue;
      storeys_.push_back({name, room->floor_m, room->floor_m + cut_share * room->height_m()});
      break;
    }
  }
  for (const Storey& storey : storeys(solved.building())) {
    if (!rooms.empty()) break;
    storeys_.push_back({"Storey " + std::to_string(storeys_.size() + 1), storey.floor_m,
                        storey.floor_m + cut_share * storey.headroom_m});
  }
  std::ranges::stable_sort(storeys_, {}, &WalkStorey::floor_m);
}

std::size_t WalkStoreys::at(double height_m) const {
  std::size_t number = 0;
  for (std::size_t i = 1; i < storeys_.size(); ++i) {
    if (storeys_[i].floor_m <= height_m) number = i;
  }
  return number;
}

std::size_t WalkStoreys::of(const SurveyRoom& room) const {
  const auto own = std::ranges::find(storeys_, room.storey, &WalkStorey::name);
  return own != storeys_.end() ? static_cast<std::size_t>(own - storeys_.begin())
                               : at(room.floor_m + step_share * room.height_m());
}

std::size_t WalkStoreys::of(const Cluster& cluster, std::uint32_t polygon) const {
  const Polygon& corners = cluster.polygons[polygon].polygon;
  double apart_m = 1e30;
  for (std::size_t i = 1; i < storeys_.size(); ++i)
    apart_m = std::min(apart_m, storeys_[i].floor_m - storeys_[i - 1].floor_m);
  if (cluster.cell.valid() && cells_.cells()[cluster.cell.index()].kind == CellKind::room) {
    const Box& box = cells_.cells()[cluster.cell.index()].bounds;
    const double height_m = box.extent().z;
    if (height_m < one_storey * apart_m) return at(box.lo.z + step_share * height_m);
  }
  // A little before its front: a floor belongs to what stands on it, a ceiling to what is below.
  constexpr double before_m = 0.1;
  return at((centroid(corners) + before_m * normal(corners)).z);
}

}  // namespace enfilade
