#include "scene_file/room_reader.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/limits.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 9> room_keys{
    "name", "longName", "storey", "bbox", "outline", "z", "floorArea", "height", "required_lx"};

class RoomReader {
 public:
  RoomReader(const KeyReader& keys, double scale, const json& entry, std::string where)
      : keys_(keys), scale_(scale), entry_(entry), where_(std::move(where)) {}

  BuildingRoom read() const {
    if (!entry_.is_object())
      keys_.fail(where_, "is " + shown(entry_) + ", not an object", "write {...}");
    BuildingRoom room;
    room.name = text("name");
    room.long_name = text("longName");
    room.storey = text("storey");
    read_box(room);
    room.floor_area_m2 = scale_ * scale_ * amount("floorArea");
    room.required_lx = amount("required_lx");
    return room;
  }

 private:
  const json* find(const char* key) const {
    const auto it = entry_.find(key);
    return it == entry_.end() || it->is_null() ? nullptr : &*it;
  }
  std::string place(const char* key) const { return where_ + "." + key; }

  /// A name may be a number, as rooms' numbers often are.
  std::string text(const char* key) const {
    const json* value = find(key);
    if (value == nullptr) return {};
    return value->is_number() ? value->dump() : keys_.text(*value, place(key));
  }

  double amount(const char* key) const {
    const json* value = find(key);
    if (value == nullptr) return 0.0;
    const double x = keys_.finite(*value, place(key));
    if (x < 0.0 || x > limits::most_light)
      keys_.fail(place(key), "is " + shown(*value), "write a number from 0 on, or leave it out");
    return x;
  }

  void read_box(BuildingRoom& room) const {
    if (const json* corners = find("bbox")) {
      if (!corners->is_array() || corners->size() != 2)
        keys_.fail(place("bbox"), "is " + shown(*corners), "write [[x, y, z], [x, y, z]]");
      room.box.add(keys_.place((*corners)[0], place("bbox[0]"), scale_));
      room.box.add(keys_.place((*corners)[1], place("bbox[1]"), scale_));
    }
    if (const json* outline = find("outline")) read_outline(*outline, room);
    if (room.box.empty())
      keys_.fail(where_, "has neither \"bbox\" nor \"outline\"", "tell where the room is");
  }

  void read_outline(const json& outline, BuildingRoom& room) const {
    const std::size_t count = keys_.list(outline, place("outline")).size();
    if (count < 3 || count > limits::most_corners) {
      keys_.fail(place("outline"), "has " + std::to_string(count) + " points",
                 "an outline has 3 to " + std::to_string(limits::most_corners));
    }
    double twice_area = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      room.outline.push_back(corner(outline[i], place("outline") + "[" + std::to_string(i) + "]"));
    }
    for (std::size_t i = 0; i < count; ++i)
      twice_area += cross2(room.outline[i] - room.outline[0],
                           room.outline[(i + 1) % count] - room.outline[0]);
    if (twice_area < 0.0) std::reverse(room.outline.begin(), room.outline.end());
    Vec2 z(room.box.lo.z, room.box.hi.z);
    if (const json* heights = find("z")) {
      if (!heights->is_array() || heights->size() != 2)
        keys_.fail(place("z"), "is " + shown(*heights), "write [from, to]");
      z = scale_ * Vec2(keys_.finite((*heights)[0], place("z[0]")),
                        keys_.finite((*heights)[1], place("z[1]")));
    } else if (room.box.empty()) {
      keys_.fail(where_, "has an outline without heights", "add \"z\": [from, to]");
    }
    room.box = {};
    for (const Vec2& p : room.outline)
      for (const double height : {z.x, z.y}) {
        const Vec3 at(p, height);
        if (const auto fault = limits::fault_of_place(at))
          keys_.fail(where_, fault.what, fault.hint);
        room.box.add(at);
      }
  }

  Vec2 corner(const json& value, const std::string& where) const {
    if (!value.is_array() || value.size() != 2)
      keys_.fail(where, "is " + shown(value) + ", not a point of the plan", "write [x, y]");
    return scale_ *
           Vec2(keys_.finite(value[0], where + "[0]"), keys_.finite(value[1], where + "[1]"));
  }

  const KeyReader& keys_;
  double scale_;
  const json& entry_;
  std::string where_;
};

}  // namespace

std::vector<BuildingRoom> read_rooms(const KeyReader& keys, const json& document, double scale,
                                     std::set<std::string>& unknown) {
  std::vector<BuildingRoom> rooms;
  const auto it = document.find("rooms");
  if (it == document.end() || it->is_null()) return rooms;
  for (std::size_t i = 0; i < keys.list(*it, "rooms").size(); ++i) {
    const json& entry = (*it)[i];
    rooms.push_back(RoomReader(keys, scale, entry, "rooms[" + std::to_string(i) + "]").read());
    for (auto key = entry.begin(); key != entry.end(); ++key) {
      if (std::ranges::find(room_keys, key.key()) == room_keys.end())
        unknown.insert("rooms[]." + key.key());
    }
  }
  return rooms;
}

}  // namespace enfilade
