// Buildings that the modeler's tests make.
#pragma once

#include "building_file/description.hpp"
#include "modeler/generate.hpp"

namespace enfilade::testing {

inline Building preset(const std::string& name, const std::vector<BuildingOption>& options = {}) {
  return describe_building(*preset_description(name), name, options);
}

/// Two storeys, an arc, stairs and some of each kind of furniture.
inline Building small_building(const std::vector<BuildingOption>& options = {}) {
  return describe_building(
      R"({"floors": 2, "wings": [{"bays": 3}, {"bays": 4, "turn": 30}], "stairs": 1, "fire_doors": 1,
          "furniture": {"lamp": 40, "desk": 12, "chair": 20, "table": 4, "shelf": 8, "cupboard": 8,
                        "bin": 6, "plant": 6, "monitor": 8, "desk_lamp": 5, "picture": 20}})",
      "small.json", options);
}

}  // namespace enfilade::testing
