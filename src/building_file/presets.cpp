// Buildings that come with the program: descriptions like any other.
#include "building_file/description.hpp"

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

// The paper's counts (§5): 57,786 surfaces, 2,000 lights, 615 cells, 12,942 clusters. To tune them
// anew where cells or clusters are cut otherwise (the test Rr3425 prints what comes out):
// - Cells: one for each of the 564 rooms, 30 stretches of corridor (by storey fire doors + 1, and
//   two bends that part a corridor), 20 in the stairwells, and the outside. A fire door adds one
//   per storey; a bay two. Turns and the windows' width decide how the wings' planes meet: they are
//   to leave every room a cell.
// - Clusters without surfaces: every piece of furniture is one cluster. For one shelf (30 surfaces)
//   five pictures (6 each): 4 clusters more, a storey; for a chair (24) four: 3; for a desk (18)
//   three: 2; a table (18) likewise; a monitor (12) two: 1. What stands on the ground floor alone
//   counts once and not thrice. Another seed moves a few clusters by where furniture is dealt.
// - Surfaces: a bin has 8, a plant 15, a lamp or a cupboard 6; lights are lamps and desk lamps.
constexpr const char* rr3425 = R"({
  "format": "enfilade-building", "version": 1,
  "floors": 3,
  "wings": [{"bays": 18}, {"bays": 12, "turn": 44}, {"bays": 12}, {"bays": 12, "turn": -44},
            {"bays": 12}, {"bays": 12, "turn": 44}, {"bays": 18}],
  "stairs": 4,
  "fire_doors": 7,
  "window_width": 1.4,
  "seed": 2,
  "furniture": {"lamp": 666, "desk": 112, "chair": 108, "table": 20, "shelf": 24, "cupboard": 110,
                "bin": 59, "plant": 25, "monitor": 51, "picture": 322},
  "ground_furniture": {"lamp": 2, "bin": 1, "picture": 7}
})";

}  // namespace

std::optional<std::string> preset_description(const std::string& name) {
  if (name == "demo") return demo;
  if (name == "rr3425") return rr3425;
  return std::nullopt;
}

std::string preset_names() { return "demo, rr3425"; }

}  // namespace enfilade
