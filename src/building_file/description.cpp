#include "building_file/description.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "building_file/description_options.hpp"
#include "json/json_text.hpp"
#include "modeler/building_plan.hpp"
#include "modeler/furnishing.hpp"

namespace enfilade {
namespace {

using nlohmann::json;

constexpr const char* other_keys[] = {"format",  "version",   "wings",
                                      "windows", "furniture", "ground_furniture"};

class DescriptionReader {
 public:
  explicit DescriptionReader(Building& building) : building_(building) {}

  void read(const json& document) {
    read_head(document);
    for (const DescriptionField& field : building_fields()) {
      if (document.contains(field.key)) read_field(field, document[field.key]);
    }
    if (document.contains("wings")) read_wings(document["wings"]);
    if (document.contains("windows")) read_windows(document["windows"]);
    read_furniture(document, "furniture", building_.furniture);
    read_furniture(document, "ground_furniture", building_.ground_furniture);
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& what,
                         const std::string& hint) const {
    throw building_.fault(key, what, hint);
  }

  void read_head(const json& document) const {
    if (!document.is_object()) fail("top level", "is not an object", "write {\"floors\": 3, ...}");
    const json format = document.value("format", json("enfilade-building"));
    if (format != "enfilade-building") {
      fail("format", "is " + shown(format) + ", not a building", "write \"enfilade-building\"");
    }
    if (document.value("version", json(1)) != 1) {
      fail("version", "is " + shown(document["version"]) + ", which this program does not know",
           "write 1");
    }
    for (auto it = document.begin(); it != document.end(); ++it) check_key(it.key());
  }

  void check_key(const std::string& key) const {
    std::string all;
    for (const char* other : other_keys) all += std::string(all.empty() ? "" : ", ") + other;
    for (const DescriptionField& field : building_fields()) all += std::string(", ") + field.key;
    const auto fields = building_fields();
    const auto is_key = [&](const auto& known) { return key == known; };
    if (std::any_of(std::begin(other_keys), std::end(other_keys), is_key)) return;
    if (std::any_of(fields.begin(), fields.end(),
                    [&](const DescriptionField& field) { return key == field.key; })) {
      return;
    }
    fail(in_quotes(key), "is no key of a building", "there are " + all);
  }

  double number(const json& value, const std::string& key, double low, double high) const {
    const double x = value.is_number() ? value.get<double>() : std::nan("");
    if (std::isfinite(x) && x >= low && x <= high) return x;
    fail(key, "is " + shown(value),
         "write a number from " + shown(json(low)) + " to " + shown(json(high)));
  }
  int whole(const json& value, const std::string& key, double low, double high) const {
    const double x = value.is_number() ? value.get<double>() : std::nan("");
    if (x == std::floor(x) && x >= low && x <= high) return static_cast<int>(x);
    fail(key, "is " + shown(value),
         "write a whole number from " + shown(json(static_cast<long>(low))) + " to " +
             shown(json(static_cast<long>(high))));
  }

  void read_field(const DescriptionField& field, const json& value) {
    if (const auto* member = std::get_if<int Building::*>(&field.member)) {
      building_.** member = whole(value, field.key, field.low, field.high);
    } else if (const auto* real = std::get_if<double Building::*>(&field.member)) {
      building_.** real = number(value, field.key, field.low, field.high);
    } else {
      if (!value.is_boolean()) fail(field.key, "is " + shown(value), "write true or false");
      building_.*std::get<bool Building::*>(field.member) = value.get<bool>();
    }
  }

  void read_wings(const json& value) {
    if (!value.is_array() || value.empty()) {
      fail("wings", "is " + shown(value), "write [{\"bays\": 8, \"turn\": 45}, ...]");
    }
    building_.wings.clear();
    for (std::size_t i = 0; i < value.size(); ++i) {
      const std::string key = "wings[" + std::to_string(i) + "]";
      if (!value[i].is_object() || !value[i].contains("bays")) {
        fail(key, "is " + shown(value[i]),
             "write {\"bays\": 8, \"turn\": 45}; turn may be left out");
      }
      Wing wing;
      for (auto it = value[i].begin(); it != value[i].end(); ++it) {
        const std::string place = key + "." + it.key();
        if (it.key() == "bays") {
          wing.bays = whole(*it, place, 1, 2000);
        } else if (it.key() == "turn") {
          wing.turn_deg = number(*it, place, -350, 350);
        } else {
          fail(place, "is no key of a wing", "there are bays, turn");
        }
      }
      building_.wings.push_back(wing);
    }
  }

  void read_windows(const json& value) {
    if (value == "open") {
      building_.windows = Windows::open;
    } else if (value == "closed") {
      building_.windows = Windows::closed;
    } else if (value == "none") {
      building_.windows = Windows::none;
    } else {
      fail("windows", "is " + shown(value), "write open, closed (with panes) or none");
    }
  }

  void read_furniture(const json& document, const std::string& key, FurnitureCounts& counts) {
    if (!document.contains(key)) return;
    const json& value = document[key];
    if (!value.is_object()) fail(key, "is " + shown(value), "write {\"chair\": 12, ...}");
    std::string all;
    for (std::size_t k = 0; k < furniture_kinds; ++k) {
      const char* name = name_of(static_cast<FurnitureKind>(k));
      all += std::string(k == 0 ? "" : ", ") + name;
      if (value.contains(name)) counts[k] = whole(value[name], key + "." + name, 0, 1000000);
    }
    for (auto it = value.begin(); it != value.end(); ++it) {
      if (all.find(it.key()) == std::string::npos || !is_kind(it.key())) {
        fail(key + "." + it.key(), "is no kind of furniture", "there are " + all);
      }
    }
  }

  static bool is_kind(const std::string& name) {
    for (std::size_t k = 0; k < furniture_kinds; ++k) {
      if (name == name_of(static_cast<FurnitureKind>(k))) return true;
    }
    return false;
  }

  Building& building_;
};

// Checks values against each other.
void check_together(const Building& building) {
  if (building.window_head_m < building.window_sill_m + 0.2) {
    throw building.fault("window_head", "is not above window_sill", "leave 0.2 m between them");
  }
  if (std::max(building.door_height_m, building.window_head_m) > building.room_height_m - 0.1) {
    throw building.fault("room_height", "is less than what doors and windows need",
                         "leave 0.1 m above them");
  }
  if (building.stairs > building.bays() || building.fire_doors >= building.bays()) {
    throw building.fault(building.stairs > building.bays() ? "stairs" : "fire_doors",
                         "are more than the " + std::to_string(building.bays()) + " bays take",
                         "ask for fewer, or for more bays");
  }
  check_stairs(building);
  deal_furniture(building, plan_building(building), storey_of(building, 0));
}

}  // namespace

Building describe_building(const std::string& text, const std::string& file,
                           std::span<const BuildingOption> options) {
  Building building;
  building.file = file;
  json document = parse_json(text, file);
  for (const auto& [key, value] : options) {
    building.option_keys.push_back(key);
    if (document.is_object()) put_option(document, building, key, value);
  }
  DescriptionReader(building).read(document);
  check_together(building);
  return building;
}

}  // namespace enfilade
