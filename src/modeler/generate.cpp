#include "modeler/generate.hpp"

#include <algorithm>

#include "modeler/furnishing.hpp"
#include "modeler/storey.hpp"

namespace enfilade {
namespace {

constexpr double probe_height_m = 0.85;

void add_shells(SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
                const ModelStorey& storey) {
  for (const Bay& bay : plan.bays) {
    add_corridor(sink, building, plan, storey, bay);
    if (bay.stairs) {
      add_stairwell(sink, building, storey, bay);
    } else {
      add_room(sink, building, storey, bay, BaySide::left);
    }
    add_room(sink, building, storey, bay, BaySide::right);
    if (!building.is_furnace()) add_outer_faces(sink, building, plan, storey, bay);
  }
}

// A probe in the middle of every room, facing up.
void add_probes(const SurfaceSink& sink, const Building& building, const BuildingPlan& plan,
                const ModelStorey& storey, std::vector<Probe>& probes) {
  for (const Bay& bay : plan.bays) {
    for (const BaySide side : {BaySide::left, BaySide::right}) {
      if (side == BaySide::left && bay.stairs) continue;
      const ModelRoom room = plan_room(building, bay, side);
      const Vec2 p = room.world(0.5 * room.width_m, 0.5 * room.depth_m);
      probes.push_back({sink.placed(raised(p, storey.z_m + probe_height_m)), {0.0, 0.0, 1.0}});
    }
  }
}

}  // namespace

GeneratedCounts generate_building(const Building& described, const SurfaceSink::Receiver& receive,
                                  std::vector<Probe>* probes) {
  Building building = described;
  if (building.is_furnace() && building.windows == Windows::open) {
    building.windows = Windows::closed;
  }
  check_stairs(building);
  const BuildingPlan plan = plan_building(building);
  deal_furniture(building, plan, storey_of(building, 0));  // the fullest storey

  GeneratedCounts counts;
  SurfaceSink sink(building, [&](const Surface& surface) {
    ++counts.surfaces;
    counts.lights += std::any_of(surface.exitance.begin(), surface.exitance.end(),
                                 [](double e) { return e > 0.0; });
    receive(surface);
  });
  for (int number = 0; number < building.floors; ++number) {
    const ModelStorey storey = storey_of(building, number);
    add_shells(sink, building, plan, storey);
    for (const Space& space : deal_furniture(building, plan, storey)) {
      furnish(sink, building, plan, storey, space);
    }
    if (building.probes && probes != nullptr) {
      add_probes(sink, building, plan, storey, *probes);
    }
    counts.rooms += 2 * plan.bays.size();
  }
  return counts;
}

Scene building_scene(const Building& building) {
  Scene scene;
  scene.file = building.file;
  scene.bands = building.colours ? 3 : 1;
  scene.unit = ExitanceUnit::lumen_per_m2;
  generate_building(
      building, [&](const Surface& surface) { scene.surfaces.push_back(surface); }, &scene.probes);
  return scene;
}

}  // namespace enfilade
