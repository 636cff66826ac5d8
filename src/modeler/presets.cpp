// Buildings that come with the program: descriptions like any other.
#include "modeler/description.hpp"

namespace enfilade {
namespace {

constexpr const char* demo = R"({
  "format": "enfilade-building", "version": 1,
  "floors": 2,
  "wings": [{"bays": 2}, {"bays": 4, "turn": 50}],
  "stairs": 1,
  "fire_doors": 1,
  "colours": true,
  "window_width": 1.8,
  "furniture": {"lamp": 24, "desk": 10, "chair": 16, "table": 4, "shelf": 9, "cupboard": 6,
                "bin": 5, "plant": 5, "monitor": 7, "desk_lamp": 4, "picture": 14}
})";

constexpr const char* rr3425 = R"({
  "format": "enfilade-building", "version": 1,
  "floors": 3,
  "wings": [{"bays": 24}, {"bays": 25, "turn": 90}, {"bays": 24}, {"bays": 25, "turn": -90}],
  "stairs": 2,
  "fire_doors": 9,
  "furniture": {"lamp": 666, "desk": 100, "chair": 100, "table": 60, "shelf": 60, "cupboard": 60,
                "bin": 100, "plant": 100, "monitor": 50, "desk_lamp": 0, "picture": 300},
  "ground_furniture": {"lamp": 2}
})";

}  // namespace

std::optional<std::string> preset_description(const std::string& name) {
  if (name == "demo") return demo;
  if (name == "rr3425") return rr3425;
  return std::nullopt;
}

std::string preset_names() { return "demo, rr3425"; }

}  // namespace enfilade
