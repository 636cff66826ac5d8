#include "report/survey/building_rooms.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/clip.hpp"
#include "report/plans/level_section.hpp"
#include "report/plans/storeys.hpp"
#include "report/survey/floor_height.hpp"

namespace enfilade {
namespace {

/// Rooms are cut as high as this above their floor, or at half their height.
constexpr double cut_m = 0.75;
/// Of a room's floor, or of a cell's: so much in common, and the cell may be the room's.
constexpr double common_share = 0.5;
/// Of a told room's height: its floor lies this near to the bottom of its box.
constexpr double floor_reach_share = 0.25;
/// A cell that is lower than this share of the usual height is no room: a cupboard, a void.
constexpr double least_height_share = 0.5;

double cut_height(const Box& box) { return box.lo.z + std::min(cut_m, 0.5 * box.extent().z); }

Polygon rectangle(const Box& box) {
  return {{box.lo.x, box.lo.y, 0.0},
          {box.hi.x, box.lo.y, 0.0},
          {box.hi.x, box.hi.y, 0.0},
          {box.lo.x, box.hi.y, 0.0}};
}

/// What a told room's box cuts out of the cells.
struct BoxSection {
  std::map<CellId, std::vector<Polygon>> parts;
  std::map<CellId, double> area_m2;
  std::map<CellId, double> fit;  ///< area in common by the area of both together
};

/// Plans of the rooms that are told by their boxes.
class BoxPlans {
 public:
  BoxPlans(const CellComplex& cells, std::span<const BuildingRoom> told)
      : cells_(cells), told_(told) {
    for (const BuildingRoom& room : told)
      sections_.push_back(room.outline.empty() ? section_of(room) : BoxSection{});
  }

  RoomPlan plan(std::size_t i) const {
    std::vector<Polygon> parts;
    for (const auto& [cell, polygons] : sections_[i].parts) {
      if (!belongs(cell, i)) continue;
      for (const Polygon& polygon : polygons) add_less_smaller_rooms(polygon, cell, i, parts);
    }
    if (parts.empty()) {
      for (const auto& [cell, polygons] : sections_[i].parts) {
        if (cell.valid() && kind(cell) != CellKind::solid)
          parts.insert(parts.end(), polygons.begin(), polygons.end());
      }
    }
    if (parts.empty()) parts.push_back(rectangle(told_[i].box));
    return RoomPlan(std::move(parts));
  }

 private:
  CellKind kind(CellId cell) const { return cells_.cells()[cell.index()].kind; }

  double area_of(std::size_t i) const {
    const Vec3 size = told_[i].box.extent();
    return told_[i].floor_area_m2 > 0.0 ? told_[i].floor_area_m2 : size.x * size.y;
  }

  BoxSection section_of(const BuildingRoom& room) const {
    BoxSection section;
    const double z_m = cut_height(room.box);
    const Vec3 size = room.box.extent();
    const double own_m2 = room.floor_area_m2 > 0.0 ? room.floor_area_m2 : size.x * size.y;
    for (CellSection& found : level_section(cells_, room.box, z_m)) {
      section.area_m2[found.cell] = found.area_m2;
      if (found.cell.valid() && kind(found.cell) == CellKind::room) {
        double whole_m2 = 0.0;
        for (const CellSection& all :
             level_section(cells_, cells_.cells()[found.cell.index()].bounds, z_m)) {
          if (all.cell == found.cell) whole_m2 = all.area_m2;
        }
        const double smaller_m2 = std::min(own_m2, std::max(whole_m2, found.area_m2));
        if (found.area_m2 >= common_share * smaller_m2)
          section.fit[found.cell] =
              found.area_m2 / std::max(own_m2 + whole_m2 - found.area_m2, found.area_m2);
      }
      section.parts[found.cell] = std::move(found.parts);
    }
    return section;
  }

  bool belongs(CellId cell, std::size_t i) const {
    const auto own = sections_[i].fit.find(cell);
    if (own == sections_[i].fit.end()) return false;
    if (sections_[i].area_m2.at(cell) >= common_share * area_of(i)) return true;
    return std::ranges::none_of(sections_, [&](const BoxSection& other) {
      const auto it = other.fit.find(cell);
      return it != other.fit.end() && it->second > own->second;
    });
  }

  /// Where boxes of rooms that no wall parts overlap, the place is the smaller room's.
  void add_less_smaller_rooms(const Polygon& polygon, CellId cell, std::size_t i,
                              std::vector<Polygon>& parts) const {
    std::vector<Polygon> left{polygon};
    for (Vec3& p : left[0]) p.z = 0.0;
    for (std::size_t k = 0; k < told_.size(); ++k) {
      const bool cuts = k != i && told_[k].outline.empty() && area_of(k) < area_of(i) &&
                        told_[k].box.overlaps(told_[i].box) && belongs(cell, k);
      if (!cuts) continue;
      std::vector<Polygon> next;
      for (const Polygon& part : left) {
        for (Polygon& rest : subtract_coplanar(part, rectangle(told_[k].box), 1e-9))
          next.push_back(std::move(rest));
      }
      left = std::move(next);
    }
    parts.insert(parts.end(), left.begin(), left.end());
  }

  const CellComplex& cells_;
  std::span<const BuildingRoom> told_;
  std::vector<BoxSection> sections_;
};

RoomPlan plan_of_cell(const CellComplex& cells, const Cell& cell, double z_m) {
  for (CellSection& section : level_section(cells, cell.bounds, z_m)) {
    if (section.cell == cell.id) return RoomPlan(std::move(section.parts));
  }
  return {};
}

/// The room of a cell; without a plan where it has no floor.
SurveyRoom room_of_cell(const PlannedBuilding& building, const Cell& cell) {
  SurveyRoom room;
  room.name = "cell " + std::to_string(cell.id.value);
  const double z_m = cell.bounds.lo.z + std::min(2.0 * cut_m, 0.5 * cell.bounds.extent().z);
  room.plan = plan_of_cell(building.cells, cell, z_m);
  if (room.plan.empty()) return room;
  const FloorHeight found = floor_height(building.occluders, room.plan, z_m);
  if (!found.floor_m) return {};
  room.has_floor = true;
  room.floor_m = *found.floor_m;
  room.has_ceiling = found.ceiling_m.has_value();
  room.ceiling_m = found.ceiling_m.value_or(std::max(cell.bounds.hi.z, z_m));
  room.plan =
      plan_of_cell(building.cells, cell, room.floor_m + std::min(cut_m, 0.5 * room.height_m()));
  room.area_m2 = room.plan.area_m2();
  return room;
}

double usual_height(std::vector<SurveyRoom> rooms) {
  double total_m2 = 0.0, below_m2 = 0.0;
  for (const SurveyRoom& room : rooms) total_m2 += room.area_m2;
  std::ranges::sort(rooms, {}, &SurveyRoom::height_m);
  for (const SurveyRoom& room : rooms) {
    if ((below_m2 += room.area_m2) >= 0.5 * total_m2) return room.height_m();
  }
  return 0.0;
}

std::vector<SurveyRoom> rooms_of_cells(const PlannedBuilding& building) {
  std::vector<SurveyRoom> rooms;
  for (const Cell& cell : building.cells.cells()) {
    if (cell.kind != CellKind::room) continue;
    SurveyRoom room = room_of_cell(building, cell);
    if (!room.plan.empty()) rooms.push_back(std::move(room));
  }
  const double usual_m = usual_height(rooms);
  std::erase_if(rooms, [&](const SurveyRoom& room) {
    return room.height_m() < least_height_share * usual_m;
  });
  return rooms;
}

SurveyRoom told_room(const Occluders& occluders, const BuildingRoom& told, RoomPlan plan) {
  SurveyRoom room{told.name, told.long_name, told.storey, std::move(plan)};
  room.area_m2 = told.floor_area_m2 > 0.0 ? told.floor_area_m2 : room.plan.area_m2();
  room.required = told.required_lx;
  const double height_m = told.box.extent().z;
  const FloorHeight found = floor_height(occluders, room.plan, cut_height(told.box));
  // A floor far from where the file says is seen through a hole, or past a roof.
  room.has_floor = found.floor_m && std::abs(*found.floor_m - told.box.lo.z) <=
                                        std::max(floor_reach_share * height_m, 1e-9);
  room.floor_m = room.has_floor ? *found.floor_m : told.box.lo.z;
  room.has_ceiling = found.ceiling_m.has_value();
  room.ceiling_m = found.ceiling_m.value_or(told.box.hi.z);
  return room;
}

/// "Storey 2", of the highest storey whose floor is not clearly above the room's.
std::string storey_of(const SurveyRoom& room, const std::vector<Storey>& all) {
  std::size_t number = 1;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].floor_m <= room.floor_m + 0.3 * room.height_m()) number = i + 1;
  }
  return "Storey " + std::to_string(number);
}

}  // namespace

std::vector<SurveyRoom> rooms_of_building(const PlannedBuilding& building,
                                          std::span<const BuildingRoom> told) {
  std::vector<SurveyRoom> rooms;
  const BoxPlans plans(building.cells, told);
  for (std::size_t i = 0; i < told.size(); ++i) {
    RoomPlan plan = told[i].outline.empty() ? plans.plan(i) : RoomPlan(told[i].outline);
    rooms.push_back(told_room(building.occluders, told[i], std::move(plan)));
  }
  if (told.empty()) rooms = rooms_of_cells(building);
  const bool unnamed =
      std::ranges::any_of(rooms, [](const SurveyRoom& room) { return room.storey.empty(); });
  if (!unnamed) return rooms;
  const std::vector<Storey> all = storeys(building);
  for (SurveyRoom& room : rooms) {
    if (room.storey.empty()) room.storey = storey_of(room, all);
  }
  return rooms;
}

}  // namespace enfilade
