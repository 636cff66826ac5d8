// Buildings that come with the program: descriptions like any other.
#include "modeler/description.hpp"

namespace enfilade {
namespace {

constexpr const char* demo = R"({
  "format": "enfilade-building", "version": 1,
  "floors": 2,
  "wings": [{"bays": 1}, {"bays": 2, "turn": 20}],
  "stairs": 1,
  "bay_width": 4.2,
  "colours": true,
  "window_width": 1.8,
  "furniture": {"lamp": 21, "desk": 8, "chair": 11, "table": 4, "shelf": 8, "cupboard": 5, "bin": 4,
                "plant": 4, "monitor": 6, "desk_lamp": 4, "picture": 12}
})";

constexpr const char* rr3425 = R"({
  "format": "enfilade-building", "version": 1,
  "floors": 3,
  "wings": [{"bays": 18}, {"bays": 12, "turn": 44}, {"bays": 12}, {"bays": 12, "turn": -44},
            {"bays": 12}, {"bays": 12, "turn": 44}, {"bays": 18}],
  "stairs": 4,
  "fire_doors": 9,
  "window_width": 1.4,
  "furniture": {"lamp": 666, "desk": 110, "chair": 110, "table": 20, "shelf": 20, "cupboard": 110,
                "bin": 62, "plant": 25, "monitor": 50, "picture": 337},
  "ground_furniture": {"lamp": 2, "bin": 1}
})";

}  // namespace

std::optional<std::string> preset_description(const std::string& name) {
  if (name == "demo") return demo;
  if (name == "rr3425") return rr3425;
  return std::nullopt;
}

std::string preset_names() { return "demo, rr3425"; }

}  // namespace enfilade
