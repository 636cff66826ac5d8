#include "import/intake/scene_bytes.hpp"

#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

TEST(SceneBytes, AllComesBack) {
  Scene scene;
  scene.file = "a.x";
  scene.bands = 2;
  scene.unit = ExitanceUnit::lumen_per_m2;
  scene.hash = 42;
  scene.surfaces.push_back(
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0.1, 0.2}, {3.0, 4.0}, "name", "object", false});
  scene.surfaces.push_back({{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {0.5, 0.5}, {0, 0}, "", "", true});
  scene.lights.push_back({{1, 2, 3}, {5.0, 6.0}});
  scene.lights.push_back(spot_light({1, 1, 1}, {1, 0, -1}, {2.0, 3.0}, {0.1, 0.2}));
  IntensityTable table{PhotometryType::c, {0, 90}, {0, 45, 90}, {3, 2, 1, 3, 1, 0}};
  scene.surfaces[0].distribution = std::make_shared<const IntensityDistribution>(table);
  scene.surfaces[0].up = {0, 1, 0};
  scene.lights.push_back({{2, 2, 2}, {1.0, 1.0}});
  scene.lights.back().distribution = scene.surfaces[0].distribution;
  scene.lights.back().shape = {OpeningShape::disc, {0.2, 0.2, 0}};
  scene.building.rooms.push_back(
      {"1", "Office", "Level 1", {{0, 0, 0}, {4, 5, 3}}, {{0, 0}, {4, 0}, {4, 5}}, 20.0, 500.0});
  scene.building.portals.push_back({"IfcDoor", "door", {{0, 0, 0}, {1, 0.1, 2}}, 0.7});
  scene.building.luminaires.push_back({"lamp", "type", {1, 2, 3}, 800.0});
  Warnings warnings;
  warnings.add("here", "is a fault");
  Warnings found;
  const Scene back = scene_from(bytes_of(scene, warnings), found);
  EXPECT_EQ(all_warnings(found), "here: is a fault\n");
  EXPECT_EQ(back.hash, 42u);
  ASSERT_EQ(back.surfaces.size(), 2u);
  EXPECT_EQ(back.lights.at(2).distribution, back.surfaces[0].distribution);
  EXPECT_TRUE(back.surfaces[1].two_sided);
  const TemporaryFolder folder;
  write_scene(scene, folder.file("a.json"));
  write_scene(back, folder.file("b.json"));
  const auto text = [&](const char* name) {
    std::ifstream in(folder.file(name));
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(text("a.json"), text("b.json"));
  EXPECT_THAT(text("b.json"), testing::HasSubstr("\"required_lx\":500"));
  EXPECT_THAT(text("b.json"), testing::HasSubstr("\"outline\":[[0.0,0.0],[4.0,0.0],[4.0,5.0]]"));
  EXPECT_THAT(text("b.json"), testing::HasSubstr("\"flux_lm\":800"));
  EXPECT_THAT(text("b.json"), testing::HasSubstr("\"transmittance\":0.7"));
}

TEST(SceneBytes, CutOffBytesAreAnError) {
  Warnings warnings;
  const std::vector<std::byte> bytes = bytes_of(Scene{}, warnings);
  EXPECT_THROW(scene_from(std::span(bytes).first(bytes.size() - 1), warnings), RunError);
}

}  // namespace
}  // namespace enfilade
