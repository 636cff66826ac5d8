// Which space gets which furniture, and where in the space it stands.
#pragma once

#include <vector>

#include "modeler/furniture.hpp"
#include "modeler/storey.hpp"

namespace enfilade {

/// A place for furniture: a room, a bay's stretch of the corridor, or a stairwell's landing.
struct Space {
  enum class Kind { room, corridor, stairs };
  Kind kind = Kind::room;
  int bay = 0;
  BaySide side = BaySide::left;
  FurnitureCounts has{};
};

/// Returns a storey's spaces with all of the building's furniture distributed evenly, in an order
/// that the seed and the storey choose. Throws InputError where there is more of a kind than there
/// are places.
std::vector<Space> deal_furniture(const Building& building, const BuildingPlan& plan,
                                  const ModelStorey& storey);
/// How many of a kind find place in a space that holds what it `has` so far.
int places_for(const Building& building, const BuildingPlan& plan, const Space& space,
               FurnitureKind kind);
/// Where the i-th of a kind stands, for add_furniture.
Frame place_of(const Building& building, const BuildingPlan& plan, const ModelStorey& storey,
               const Space& space, FurnitureKind kind, int i);
/// All that a space has, each piece an object.
void furnish(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
             const ModelStorey& storey, const Space& space);
std::string space_name(const BuildingPlan& plan, const ModelStorey& storey, const Space& space);

}  // namespace enfilade
