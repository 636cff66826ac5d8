#include "light_survey/light_survey.hpp"

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

/// A closed room of 4 x 4 x 3 m with a panel below its ceiling, which shines down.
Scene lit_room() {
  Scene scene;
  const auto add = [&](const char* name, Polygon polygon, double exitance) {
    scene.surfaces.push_back({std::move(polygon), {0.5}, {exitance}, name, name, false});
  };
  add("floor", {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, 0);
  add("ceiling", {{0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3}}, 0);
  add("south", {{0, 0, 0}, {0, 0, 3}, {4, 0, 3}, {4, 0, 0}}, 0);
  add("north", {{0, 4, 0}, {4, 4, 0}, {4, 4, 3}, {0, 4, 3}}, 0);
  add("west", {{0, 0, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 3}}, 0);
  add("east", {{4, 0, 0}, {4, 0, 3}, {4, 4, 3}, {4, 4, 0}}, 0);
  add("panel", {{1, 1, 2.99}, {1, 2, 2.99}, {2, 2, 2.99}, {2, 1, 2.99}}, 100);
  return scene;
}

std::string told(const Scene& scene) {
  Warnings warnings;
  survey_light(scene, warnings);
  return all_warnings(warnings);
}

TEST(LightSurvey, AGoodRoomIsNoNews) {
  EXPECT_EQ(told(lit_room()), "");
  EXPECT_NEAR(light_sources(lit_room()).power[0], 100.0, 1e-9);
  EXPECT_EQ(light_sources(lit_room()).surfaces, 1u);
}

TEST(LightSurvey, DarknessIsTold) {
  Scene scene = lit_room();
  scene.surfaces.pop_back();
  EXPECT_THAT(told(scene), HasSubstr("scene: has no light"));
  scene.lights.push_back({{2, 2, 1}, {10.0}});
  EXPECT_EQ(told(scene), "");
}

TEST(LightSurvey, ARoomInsideOutIsTold) {
  Scene scene = lit_room();
  for (std::size_t i = 0; i < 6; ++i)
    std::reverse(scene.surfaces[i].vertices.begin(), scene.surfaces[i].vertices.end());
  EXPECT_THAT(told(scene), HasSubstr("\"floor\": faces away from the lamps: 100 % of their light"));
  for (std::size_t i = 0; i < 6; ++i) scene.surfaces[i].two_sided = true;
  EXPECT_EQ(told(scene), "");
}

TEST(LightSurvey, ALampThatLightsItsCeilingIsTold) {
  Scene scene = lit_room();
  std::reverse(scene.surfaces.back().vertices.begin(), scene.surfaces.back().vertices.end());
  EXPECT_THAT(told(scene), HasSubstr("\"panel\": lamp that lights little but what stands close"));
  scene.surfaces.back().two_sided = true;  // half of its light goes down
  EXPECT_EQ(told(scene), "");
}

}  // namespace
}  // namespace enfilade
