#include "shares/share_groups.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Surface lamp(const std::string& name, const std::string& object, double exitance,
             const std::string& on = "") {
  Surface surface;
  surface.reflectance = {0.5};
  surface.exitance = {exitance};
  surface.name = name;
  surface.object = object;
  surface.switch_name = on;
  return surface;
}

LightSource light(const std::string& name, double intensity, const std::string& on = "") {
  LightSource source{Vec3(0.0), {intensity}};
  source.name = name;
  source.switch_name = on;
  return source;
}

std::vector<std::string> names_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const ShareGroup& group : share_groups(scene)) names.push_back(group.name);
  return names;
}

TEST(ShareGroups, GoBySwitchThenByObjectThenByName) {
  Scene scene;
  scene.surfaces = {lamp("top", "lamp A", 5.0),
                    lamp("side", "lamp A", 5.0),
                    lamp("strip", "", 1.0),
                    lamp("wall", "", 0.0),
                    lamp("", "", 2.0),
                    lamp("x", "lamp B", 3.0, "north"),
                    lamp("y", "lamp C", 3.0, "north")};
  scene.lights = {light("spot", 1.0), light("", 2.0), light("dark", 0.0),
                  light("spot 2", 1.0, "north")};
  const std::vector<ShareGroup> groups = share_groups(scene);
  EXPECT_THAT(names_of(scene),
              ElementsAre("spot", "light 1", "north", "lamp A", "strip", "surface 4"));
  EXPECT_THAT(groups[2].lights, ElementsAre(3u));
  EXPECT_THAT(groups[2].surfaces, ElementsAre(SurfaceId(5u), SurfaceId(6u)));
  EXPECT_THAT(groups[3].surfaces, ElementsAre(SurfaceId(0u), SurfaceId(1u)));
}

TEST(ShareGroups, OfADarkSceneAreRefused) {
  Scene scene;
  scene.file = "dark.json";
  scene.surfaces = {lamp("wall", "", 0.0)};
  try {
    share_groups(scene);
    FAIL() << "a dark scene has shares";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("dark.json"));
    EXPECT_THAT(error.what(), HasSubstr("nothing in the scene emits light"));
  }
}

TEST(ShareGroups, AreFoundByNameAlone) {
  const std::vector<std::string> names = {"spot", "north"};
  EXPECT_EQ(find_group(names, "north", "--switch"), 1u);
  try {
    find_group(names, "nor", "--switch");
    FAIL() << "a part of a name was taken for the name";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("spot, north"));
  }
}

}  // namespace
}  // namespace enfilade
