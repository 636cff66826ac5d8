#include "unit/cells/rooms/room_score.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace enfilade {
namespace {

Vec3 point_of(const nlohmann::json& json) { return {json.at(0), json.at(1), json.at(2)}; }

Box box_of(const nlohmann::json& json) {
  Box box;
  box.add(point_of(json.at("bbox").at(0)));
  box.add(point_of(json.at("bbox").at(1)));
  return box;
}

double volume(const Box& box) {
  const Vec3 e = box.extent();
  return e.x * e.y * e.z;
}

/// The smallest room around the point; -1 where there is none.
int room_at(const KnownBuilding& building, const Vec3& p) {
  int best = -1;
  for (std::size_t i = 0; i < building.rooms.size(); ++i) {
    const Box& box = building.rooms[i].box;
    if (!box.contains(p, 0.0)) continue;
    if (best < 0 || volume(box) < volume(building.rooms[static_cast<std::size_t>(best)].box)) {
      best = static_cast<int>(i);
    }
  }
  return best;
}

struct Counts {
  std::map<std::pair<int, std::uint32_t>, double> both;
  std::map<int, double> room;
  std::map<std::uint32_t, double> cell;

  double iou(int r, std::uint32_t c) const {
    const double common = both.at({r, c});
    return common / (room.at(r) + cell.at(c) - common);
  }
};

Counts count(const KnownBuilding& building, const CellComplex& complex, double step_m,
             Vec3 (*move)(const Vec3&)) {
  Box all;
  for (const KnownBox& room : building.rooms) {
    all.add(room.box.lo - Vec3(1.0));
    all.add(room.box.hi + Vec3(1.0));
  }
  Counts counts;
  for (double x = all.lo.x + 0.5 * step_m; x < all.hi.x; x += step_m) {
    for (double y = all.lo.y + 0.5 * step_m; y < all.hi.y; y += step_m) {
      for (double z = all.lo.z + 0.5 * step_m; z < all.hi.z; z += step_m) {
        const int room = room_at(building, {x, y, z});
        const CellId cell = complex.locate(move({x, y, z}));
        if (room >= 0) counts.room[room] += 1.0;
        if (cell.valid()) counts.cell[cell.value] += 1.0;
        if (room >= 0 && cell.valid()) counts.both[{room, cell.value}] += 1.0;
      }
    }
  }
  return counts;
}

void match_rooms(const Counts& counts, RoomScore& score) {
  std::vector<std::tuple<double, int, std::uint32_t>> pairs;
  for (const auto& [key, common] : counts.both) {
    pairs.emplace_back(-counts.iou(key.first, key.second), key.first, key.second);
  }
  std::sort(pairs.begin(), pairs.end());
  std::map<std::uint32_t, bool> taken;
  for (const auto& [iou, room, cell] : pairs) {
    RoomScore::Room& of = score.rooms[static_cast<std::size_t>(room)];
    if (of.cell.valid() || taken[cell]) continue;
    of.cell = CellId(cell);
    of.iou = -iou;
    taken[cell] = true;
  }
}

/// Is the cell at q the one that q's room has, or outside where q is in no room?
bool is_right(const KnownBuilding& building, const RoomScore& score, const CellComplex& complex,
              const Vec3& q, CellId cell) {
  if (!cell.valid()) return false;
  const int room = room_at(building, q);
  if (room < 0) return complex.cells()[cell.index()].kind == CellKind::outside;
  return score.rooms[static_cast<std::size_t>(room)].cell == cell;
}

RoomScore::Door judge_door(const KnownBuilding& building, const RoomScore& score,
                           const CellComplex& complex, const KnownBox& door,
                           Vec3 (*move)(const Vec3&)) {
  const Vec3 e = door.box.extent(), middle = door.box.center();
  const Vec3 across = e.x < e.y ? Vec3(0.5 * e.x + 0.3, 0, 0) : Vec3(0, 0.5 * e.y + 0.3, 0);
  const Vec3 p = middle - across, q = middle + across;
  RoomScore::Door found{door.name, complex.locate(move(p)), complex.locate(move(q)), false};
  if (!is_right(building, score, complex, p, found.a)) return found;
  if (!is_right(building, score, complex, q, found.b) || found.a == found.b) return found;
  Box around;
  for (int k = 0; k < 8; ++k) {
    around.add(move({k & 1 ? door.box.lo.x : door.box.hi.x, k & 2 ? door.box.lo.y : door.box.hi.y,
                     k & 4 ? door.box.lo.z : door.box.hi.z}));
  }
  for (const Portal& portal : complex.portals()) {
    const bool joins = (portal.a == found.a && portal.b == found.b) ||
                       (portal.a == found.b && portal.b == found.a);
    found.right |= joins && bounds(portal.polygon).overlaps(around, 0.05);
  }
  return found;
}

}  // namespace

KnownBuilding read_known_building(const std::string& scene_file) {
  std::ifstream in(scene_file);
  const nlohmann::json json = nlohmann::json::parse(in);
  KnownBuilding building;
  for (const auto& room : json.at("rooms")) {
    building.rooms.push_back(
        {room.value("name", "") + " " + room.value("longName", ""), box_of(room)});
  }
  for (const auto& portal : json.at("portals")) {
    if (portal.at("kind") == "IfcDoor") {
      building.doors.push_back({portal.value("name", ""), box_of(portal)});
    }
  }
  return building;
}

double RoomScore::rooms_share() const {
  const auto own = [](const Room& room) { return room.iou >= 0.5; };
  return static_cast<double>(std::count_if(rooms.begin(), rooms.end(), own)) /
         static_cast<double>(rooms.size());
}

double RoomScore::doors_share() const {
  const auto right = [](const Door& door) { return door.right; };
  return static_cast<double>(std::count_if(doors.begin(), doors.end(), right)) /
         static_cast<double>(doors.size());
}

RoomScore score_rooms(const KnownBuilding& building, const CellComplex& complex, double step_m,
                      Vec3 (*move)(const Vec3&)) {
  RoomScore score;
  for (const KnownBox& room : building.rooms) score.rooms.push_back({room.name, {}, 0.0});
  match_rooms(count(building, complex, step_m, move), score);
  for (const KnownBox& door : building.doors) {
    score.doors.push_back(judge_door(building, score, complex, door, move));
  }
  return score;
}

}  // namespace enfilade
