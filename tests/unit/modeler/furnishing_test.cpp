#include "modeler/furnishing.hpp"

#include <gtest/gtest.h>

#include <map>

#include "unit/modeler/buildings.hpp"

namespace enfilade {
namespace {

using testing::small_building;

/// As full as can be.
Building crammed(const char* wings) {
  Building building = small_building(
      {{"wings", wings}, {"furniture", "chair=0,monitor=0,desk_lamp=0,bin=0,plant=0,picture=0"}});
  const BuildingPlan plan = plan_building(building);
  for (std::size_t k = 0; k < furniture_kinds; ++k) {
    building.furniture[k] = 0;
    for (const Space& space : deal_furniture(building, plan, storey_of(building, 0))) {
      building.furniture[k] += places_for(building, plan, space, static_cast<FurnitureKind>(k));
    }
    // Half shelves, half cupboards.
    if (static_cast<FurnitureKind>(k) == FurnitureKind::shelf) building.furniture[k] /= 2;
  }
  return building;
}

struct Thing {
  std::string object;
  Box box;  ///< in the room's own frame
};

/// The furniture of a room, measured in the room's frame.
std::vector<Thing> things_in(const Building& building, const BuildingPlan& plan,
                             const ModelStorey& storey, const Space& space) {
  const ModelRoom room =
      plan_room(building, plan.bays[static_cast<std::size_t>(space.bay)], space.side);
  std::map<std::string, Box> boxes;
  SurfaceSink sink(building, [&](const Surface& s) {
    for (const Vec3& p : s.vertices) {
      const Vec2 d = Vec2(p.x, p.y) - room.origin;
      boxes[s.object].add(Vec3(glm::dot(d, room.x), glm::dot(d, room.y), p.z - storey.z_m));
    }
  });
  furnish(sink, building, plan, storey, space);
  std::vector<Thing> things;
  for (const auto& [object, box] : boxes) things.push_back({object, box});
  return things;
}

TEST(Furnishing, NothingPokesIntoAnythingNorBlocksADoor) {
  for (const char* wings : {"4", "4:35", "4:-35"}) {
    const Building building = crammed(wings);
    const BuildingPlan plan = plan_building(building);
    const ModelStorey storey = storey_of(building, 1);
    for (const Space& space : deal_furniture(building, plan, storey)) {
      if (space.kind != Space::Kind::room) continue;
      Box way_in;  // from the door, and a step into the room
      way_in.add(Vec3(0.3, 0.0, 0.0));
      way_in.add(Vec3(0.3 + building.door_width_m, 1.2, 2.0));
      const auto things = things_in(building, plan, storey, space);
      EXPECT_GT(things.size(), 15u);
      for (std::size_t i = 0; i < things.size(); ++i) {
        EXPECT_FALSE(things[i].box.overlaps(way_in)) << things[i].object;
        for (std::size_t j = 0; j < i; ++j) {
          EXPECT_FALSE(things[i].box.overlaps(things[j].box))
              << things[i].object << " and " << things[j].object << " with " << wings;
        }
      }
    }
  }
}

TEST(Furnishing, StaysOffWallsFloorAndCeiling) {
  for (const char* wings : {"4", "4:35", "4:-35"}) {
    const Building building = crammed(wings);
    const BuildingPlan plan = plan_building(building);
    const ModelStorey storey = storey_of(building, 0);
    for (const Space& space : deal_furniture(building, plan, storey)) {
      if (space.kind != Space::Kind::room) continue;
      const ModelRoom room =
          plan_room(building, plan.bays[static_cast<std::size_t>(space.bay)], space.side);
      SurfaceSink sink(building, [&](const Surface& s) {
        for (const Vec3& p : s.vertices) {
          EXPECT_GT(p.z, storey.z_m + 0.005) << s.object;
          EXPECT_LT(p.z, storey.z_m + building.room_height_m - 0.005) << s.object;
          for (std::size_t i = 0; i < 4; ++i) {
            const Vec2 a = room.corners[i], e = glm::normalize(room.corners[(i + 1) % 4] - a);
            EXPECT_GT(e.x * (p.y - a.y) - e.y * (p.x - a.x), 0.01) << s.object << " " << s.name;
          }
        }
      });
      furnish(sink, building, plan, storey, space);
    }
  }
}

TEST(Furnishing, DealsExactlyWhatWasAskedForAndEvenly) {
  const Building building = small_building();
  const BuildingPlan plan = plan_building(building);
  const auto spaces = deal_furniture(building, plan, storey_of(building, 0));
  for (std::size_t k = 0; k < furniture_kinds; ++k) {
    int sum = 0;
    for (const Space& space : spaces) sum += space.has[k];
    EXPECT_EQ(sum, building.furniture[k]) << name_of(static_cast<FurnitureKind>(k));
  }
  for (const Space& space : spaces) EXPECT_GE(space.has[index_of(FurnitureKind::lamp)], 1);
}

TEST(Furnishing, ALightHasOneSurfaceThatEmits) {
  for (std::size_t k = 0; k < furniture_kinds; ++k) {
    const auto kind = static_cast<FurnitureKind>(k);
    int emitting = 0, all = 0;
    SurfaceSink sink({}, [&](const Surface& s) {
      ++all;
      emitting += s.exitance[0] > 0.0;
    });
    add_furniture(sink, kind, {}, 0);
    EXPECT_EQ(emitting, is_light(kind) ? 1 : 0) << name_of(kind);
    EXPECT_EQ(all, surfaces_of(kind));
  }
}

}  // namespace
}  // namespace enfilade
