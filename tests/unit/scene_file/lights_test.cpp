// Lights of scene files: spots, luminaires, surfaces with a distribution.
#include <nlohmann/json.hpp>
#include <numbers>

#include "scene/photopic.hpp"
#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

using std::numbers::pi;
constexpr const char* cosine =
    R"({"planes": [0], "angles": [0, 30, 60, 90], "candela": [[100, 86.6, 50, 0]]})";
const std::string ies =
    "IESNA:LM-63-2002\nTILT=INCLUDE\n1\n2\n0 90\n1 0.5\n1 -1 1 3 1 1 2 0.2 0.6 0\n1 1 20\n"
    "0 45 90\n0\n300 200 0\n";

class SceneLights : public testing::Test {
 protected:
  std::string text(const std::string& keys, const std::string& unit = "lm/m2",
                   const std::string& surface = "") {
    return R"({"exitanceUnits": ")" + unit +
           R"(", "surfaces": [{"vertices": [[0,0,0],[2,0,0],[2,1,0],[0,1,0]], "reflectance": 0.5)" +
           surface + "}], " + keys + "}";
  }
  Scene read(const std::string& text) {
    return read_scene(folder_.write("s.json", text), warnings_);
  }
  std::string fault(const std::string& keys) {
    const std::string path = folder_.write("bad.json", text(keys));
    return input_error([&] { read_scene(path, warnings_); });
  }
  static double flux_of(const LightSource& light) { return 4.0 * pi * light.intensity[0]; }

  TemporaryFolder folder_;
  Warnings warnings_;
};

TEST_F(SceneLights, SpotHasKhrsCones) {
  const Scene scene =
      read(text(R"("lights": [{"type": "spot", "p": [1, 2, 3], "direction": [0, 1, 0],
      "intensity": [10, 20], "innerConeAngle": 0.2, "outerConeAngle": 0.5}])"));
  ASSERT_EQ(scene.lights.size(), 1u);
  const LightSource& spot = scene.lights[0];
  const auto intensity = [&](double angle) {
    return spot.intensity[1] * relative_intensity(spot, {std::sin(angle), std::cos(angle), 0});
  };
  EXPECT_NEAR(intensity(0.0), 20.0, 1e-9);
  EXPECT_NEAR(intensity(0.19), 20.0, 1e-9);
  const double share = (std::cos(0.35) - std::cos(0.5)) / (std::cos(0.2) - std::cos(0.5));
  EXPECT_NEAR(intensity(0.35), 20.0 * share * share, 1e-3);
  EXPECT_EQ(intensity(0.51), 0.0);
  EXPECT_TRUE(warnings_.empty()) << all_warnings(warnings_);
  EXPECT_THAT(fault(R"("lights": [{"type": "spot", "p": [1, 2, 3], "intensity": 1}])"),
              HasSubstr("has no \"direction\""));
  EXPECT_THAT(fault(R"("lights": [{"type": "spot", "p": [1, 2, 3], "direction": [1, 0, 0],
                     "intensity": 1, "innerConeAngle": 2, "outerConeAngle": 1}])"),
              HasSubstr("cone angles"));
}

TEST_F(SceneLights, LuminaireOfAFileIsKeptInTheScenesText) {
  folder_.write("lamp.ies", ies);
  const Scene scene = read(text(R"("luminaires": [
      {"file": "lamp.ies", "p": [1, 2, 3], "name": "a"},
      {"file": "lamp.ies", "p": [1, 2, 3], "aim": [1, 0, 0], "up": [0, 0, 1]},
      {"file": "lamp.ies", "p": [1, 2, 3], "flux": 5000, "size": 0},
      {"name": "a fixture", "p": [1, 2, 3], "flux_lm": 800}])"));
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_TRUE(warnings_.empty()) << all_warnings(warnings_);
  const LightSource& first = scene.lights[0];
  EXPECT_NEAR(flux_of(first), first.distribution->flux(), 1e-9);
  EXPECT_EQ(first.distribution, scene.lights[1].distribution);
  EXPECT_EQ(first.shape.shape, OpeningShape::rectangle);
  EXPECT_EQ(first.shape.size, Vec3(0.6, 0.2, 0));
  EXPECT_NEAR(flux_of(scene.lights[1]), 0.5 * flux_of(first), 1e-9);  // lamps' tilt at 90 degrees
  EXPECT_EQ(scene.lights[1].frame.right, Vec3(0, -1, 0));
  EXPECT_NEAR(flux_of(scene.lights[2]), 5000.0, 1e-9);
  EXPECT_EQ(scene.lights[2].shape.shape, OpeningShape::point);
  // The text needs no other file, and is the same scene.
  const TemporaryFolder other;
  const Scene copy = read_scene(other.write("s.json", scene.text), warnings_);
  EXPECT_EQ(copy.hash, scene.hash);
  ASSERT_EQ(copy.lights.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_DOUBLE_EQ(flux_of(copy.lights[i]), flux_of(scene.lights[i])) << i;
    EXPECT_EQ(copy.lights[i].shape.size, scene.lights[i].shape.size);
    EXPECT_EQ(copy.lights[i].frame.right, scene.lights[i].frame.right);
  }
  // Another file is another scene.
  folder_.write("lamp.ies", ies.substr(0, ies.size() - 2) + "1\n");
  const std::string changed = folder_.file("s.json");
  EXPECT_NE(read_scene(changed, warnings_).hash, scene.hash);
}

TEST_F(SceneLights, FilesLieBesideTheScene) {
  const std::string lamp = folder_.write("lamp.ies", ies);
  std::filesystem::create_directory(folder_.file("scenes"));
  const std::string path = folder_.write(
      "scenes/s.json", text(R"("luminaires": [{"file": "../lamp.ies", "p": [1, 2, 3]}])"));
  EXPECT_THAT(input_error([&] { read_scene(path, warnings_); }),
              HasSubstr("luminaires[0].file: \"" + folder_.file("scenes/../lamp.ies") +
                        "\" lies outside the model's folder"));
  EXPECT_EQ(read_scene(path, warnings_, true).lights.size(), 1u);
  EXPECT_THAT(fault(R"("luminaires": [{"file": "none.ies", "p": [1, 2, 3]}])"),
              HasSubstr("does not exist"));
}

TEST_F(SceneLights, LuminaireOfATableInWattsByTheEfficacyOf179) {
  const std::string lamp = std::string(R"("luminaires": [{"distribution": )") + cosine +
                           R"(, "p": [1, 2, 3], "flux": 1790}])";
  EXPECT_NEAR(flux_of(read(text(lamp)).lights.at(0)), 1790.0, 1e-9);
  EXPECT_TRUE(warnings_.empty());
  EXPECT_NEAR(flux_of(read(text(lamp, "W/m2")).lights.at(0)), 10.0, 1e-9);
  EXPECT_THAT(all_warnings(warnings_), HasSubstr("179 lm/W"));
  EXPECT_NEAR(photopic(std::vector{1.0, 1.0, 1.0}, ExitanceUnit::watt_per_m2), 179.0, 1e-9);
  EXPECT_NEAR(photopic(std::vector{0.0, 1.0, 0.0}, ExitanceUnit::lumen_per_m2), 0.7152, 1e-9);
  // Without a distribution a luminaire shines alike to all sides.
  EXPECT_FALSE(
      read(text(R"("luminaires": [{"p": [1, 2, 3], "flux": 100}])")).lights[0].distribution);
}

TEST_F(SceneLights, SurfaceWithADistribution) {
  const std::string tables = std::string(R"("distributions": {"batwing": )") + cosine + "}";
  const Scene given = read(
      text(tables, "lm/m2", R"(, "exitance": 40, "distribution": "batwing", "up": [1, 1, 0])"));
  ASSERT_TRUE(given.surfaces[0].distribution);
  EXPECT_EQ(given.surfaces[0].exitance[0], 40.0);
  const Scene by_flux = read(text(tables, "lm/m2", R"(, "distribution": "batwing")"));
  EXPECT_NEAR(by_flux.surfaces[0].exitance[0], given.surfaces[0].distribution->flux() / 2.0, 1e-9);
  EXPECT_TRUE(warnings_.empty()) << all_warnings(warnings_);
  EXPECT_THAT(input_error([&] {
                read(text(tables, "lm/m2", R"(, "two_sided": true, "distribution": "batwing")"));
              }),
              HasSubstr("two-sided"));
  EXPECT_THAT(input_error([&] { read(text(tables, "lm/m2", R"(, "distribution": "bat")")); }),
              HasSubstr("not among"));
}

TEST_F(SceneLights, FaultsAreToldByKey) {
  EXPECT_THAT(
      fault(
          R"("luminaires": [{"distribution": {"planes": [0], "angles": [0, 90]}, "p": [0, 0, 0]}])"),
      HasSubstr("luminaires[0].distribution: has no \"candela\""));
  EXPECT_THAT(fault(R"("luminaires": [{"distribution": {"planes": [0], "angles": [90, 0],
                     "candela": [[1, 1]]}, "p": [0, 0, 0]}])"),
              HasSubstr("do not ascend"));
  EXPECT_THAT(
      fault(R"("luminaires": [{"flux": 1, "p": [0, 0, 0], "aim": [0, 0, 1], "up": [0, 0, 1]}])"),
      HasSubstr("parallel to the aim"));
  for (const std::string size : {"[1, -1]", "[1e-300, 1e-300]", "[1, 1e-9]", "[1, 1, 1e5]"}) {
    EXPECT_THAT(fault(R"("luminaires": [{"flux": 1, "p": [0, 0, 0], "size": )" + size + "}]"),
                HasSubstr("out of range"));
  }
  EXPECT_THAT(fault(R"("luminaires": [{"flux": 1}])"), HasSubstr("has no \"p\""));
  EXPECT_THAT(fault(R"("lights": [{"type": "sun", "p": [0, 0, 0], "intensity": 1}])"),
              HasSubstr("luminaires"));
}

TEST_F(SceneLights, SwitchesOfLightsAndSurfacesAreKept) {
  const Scene scene = read(text(R"("lights": [
      {"type": "point", "p": [0, 0, 1], "intensity": 1, "switch": "point's"},
      {"type": "spot", "p": [1, 2, 3], "direction": [0, 0, 1], "intensity": 1, "switch": "spot's"}],
      "luminaires": [{"flux": 1, "p": [0, 0, 0], "switch": "luminaire's"}])",
                                "lm/m2", R"(, "exitance": 3, "switch": "surface's")"));
  const std::string path = folder_.file("out.json");
  write_scene(scene, path);
  for (const Scene& found : {scene, read_scene(path, warnings_)}) {
    ASSERT_EQ(found.lights.size(), 3u);
    EXPECT_EQ(found.lights[0].switch_name, "point's");
    EXPECT_EQ(found.lights[1].switch_name, "spot's");
    EXPECT_EQ(found.lights[2].switch_name, "luminaire's");
    EXPECT_EQ(found.surfaces[0].switch_name, "surface's");
  }
  EXPECT_TRUE(warnings_.empty()) << all_warnings(warnings_);
  EXPECT_THAT(fault(R"("luminaires": [{"flux": 1, "p": [0, 0, 0], "switch": 3}])"),
              HasSubstr("luminaires[0].switch"));
}

TEST_F(SceneLights, AreWrittenAsTheyAreRead) {
  folder_.write("lamp.ies", ies);
  Scene scene = read(
      text(std::string(R"("distributions": {"d": )") + cosine +
               R"(}, "lights": [{"type": "point", "p": [0, 0, 1], "intensity": [1, 2], "name": "x"},
      {"type": "spot", "p": [1, 2, 3], "direction": [0.6, 0, 0.8], "intensity": [10, 20]}],
      "luminaires": [{"file": "lamp.ies", "p": [1, 2, 3], "aim": [1, 0, 0], "up": [0, 0, 1]}])",
           "lm/m2", R"(, "distribution": "d", "exitance": 3)"));
  const std::string path = folder_.file("out.json");
  write_scene(scene, path);
  const Scene back = read_scene(path, warnings_);
  EXPECT_TRUE(warnings_.empty()) << all_warnings(warnings_);
  ASSERT_EQ(back.lights.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(back.lights[i].intensity[1], scene.lights[i].intensity[1], 1e-12) << i;
    EXPECT_LT(glm::length(back.lights[i].frame.aim - scene.lights[i].frame.aim), 1e-12);
    EXPECT_EQ(back.lights[i].name, scene.lights[i].name);
    EXPECT_EQ(back.lights[i].shape.size, scene.lights[i].shape.size);
  }
  ASSERT_TRUE(back.surfaces[0].distribution);
  std::ifstream in(path);
  const auto document = nlohmann::json::parse(in);
  // What others read of a spot: its flux.
  EXPECT_NEAR(document["lights"][1]["flux"][1].get<double>(),
              4.0 * pi * scene.lights[1].intensity[1], 1e-9);
}

}  // namespace
}  // namespace enfilade
