#include <chrono>

#include "unit/scene/test_scenes.hpp"
#include "unit/source_files.hpp"

namespace enfilade {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* triangle = R"("vertices": [[0,0,0],[1,0,0],[0,1,0]])";

class SceneReader : public testing::Test {
 protected:
  Scene read(const std::string& text) {
    return read_scene(folder_.write("s.json", text), warnings_);
  }
  std::string fault(const std::string& text) {
    const std::string path = folder_.write("bad.json", text);
    const std::string what = input_error([&] { read_scene(path, warnings_); });
    EXPECT_EQ(what.find(path + ": "), 0u) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_NE(what.find("; "), std::string::npos) << what;
    return what;
  }
  std::string surface_fault(const std::string& keys) {
    return fault("{\"surfaces\": [{" + std::string(triangle) + "}, {" + std::string(triangle) +
                 ", \"name\": \"lid\"" + keys + "}]}");
  }

  TemporaryFolder folder_;
  Warnings warnings_;
};

TEST_F(SceneReader, DefaultsOfAMinimalScene) {
  const Scene scene =
      read("{\"surfaces\": [{\"reflectance\": 0.25, " + std::string(triangle) + "}]}");
  ASSERT_EQ(scene.surfaces.size(), 1u);
  EXPECT_EQ(scene.bands, 1);
  EXPECT_EQ(scene.unit, ExitanceUnit::watt_per_m2);
  EXPECT_THAT(scene.surfaces[0].reflectance, ElementsAre(0.25));
  EXPECT_THAT(scene.surfaces[0].exitance, ElementsAre(0.0));
  EXPECT_FALSE(scene.surfaces[0].two_sided);
  EXPECT_TRUE(warnings_.empty()) << all_warnings(warnings_);
}

TEST_F(SceneReader, EverythingASceneCanHold) {
  const Scene scene =
      read(R"({"format": "enfilade-scene", "version": 1, "units": "cm", "exitanceUnits": "lm/m2",
    "surfaces": [{"vertices": [[0,0,0],[100,0,0],[0,200,0]], "reflectance": [0.1,0.2], "exitance": 3,
                  "name": "a", "object": "o", "two_sided": true}],
    "lights": [{"type": "point", "p": [50,50,100], "intensity": 7, "distribution": "isotropic"}],
    "probes": [{"p": [10,10,10], "n": [0,0,2]}]})");
  EXPECT_EQ(scene.bands, 2);
  EXPECT_STREQ(name_of(scene.unit), "lm/m2");
  EXPECT_STREQ(irradiance_label(scene.unit), "lx");
  EXPECT_NEAR(scene.surfaces[0].vertices[2].y, 2.0, 1e-15);
  EXPECT_THAT(scene.surfaces[0].exitance, ElementsAre(3.0, 3.0));
  EXPECT_TRUE(scene.surfaces[0].two_sided);
  EXPECT_EQ(scene.surfaces[0].object, "o");
  EXPECT_THAT(scene.lights.at(0).intensity, ElementsAre(7.0, 7.0));
  EXPECT_NEAR(scene.lights[0].p.z, 1.0, 1e-15);
  EXPECT_NEAR(scene.probes.at(0).p.x, 0.1, 1e-15);
  EXPECT_EQ(scene.probes[0].n, Vec3(0, 0, 1));
  EXPECT_TRUE(warnings_.empty()) << all_warnings(warnings_);
}

TEST_F(SceneReader, EachUnitOfLength) {
  for (const auto& [unit, metres] :
       {std::pair{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}, {"in", 0.0254}}) {
    const Scene scene =
        read("{\"units\": \"" + std::string(unit) + "\", \"surfaces\": [{" + triangle + "}]}");
    EXPECT_DOUBLE_EQ(scene.surfaces[0].vertices[1].x, metres);
  }
}

TEST_F(SceneReader, UnknownKeysGiveOneWarningThatListsThem) {
  read("{\"up\": \"y\", \"colours\": [], \"surfaces\": [{\"reflectance\": 0, \"colour\": 1, " +
       std::string(triangle) + "}]}");
  ASSERT_EQ(warnings_.all().size(), 1u);
  EXPECT_EQ(warnings_.all()[0].where, "colours, surfaces[].colour, up");
}

TEST_F(SceneReader, KeysThatDescribeTheBuildingAndItsSourceAreKnown) {
  read(R"({"up": "z", "rooms": [], "doors": "open", "portals": [], "luminaires": [],
           "offset_m": [0, 0, 0], "tool": "t", "source": "s", "licence": "l", "attribution": "a",
           "surfaces": [{"reflectance": 0, )" +
       std::string(triangle) + "}]}");
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(SceneReader, PanesHaveATransmittancePerBand) {
  const Scene scene = read(R"({"surfaces": [{"transmittance": 0.8, "reflectance": [0.1, 0.2], )" +
                           std::string(triangle) + R"(}, {"transmittance": [0.0, 0], )" + triangle +
                           "}, {\"reflectance\": 0.5, " + triangle + "}]}");
  EXPECT_THAT(scene.surfaces[0].transmittance, ElementsAre(0.8, 0.8));
  EXPECT_TRUE(scene.surfaces[0].is_pane());
  EXPECT_FALSE(scene.surfaces[1].is_pane());  // lets nothing through
  EXPECT_FALSE(scene.surfaces[2].is_pane());
  EXPECT_THAT(surface_fault(R"(, "transmittance": 1.2)"),
              HasSubstr("\"lid\".transmittance: is 1.2, outside [0, 1]"));
  EXPECT_THAT(surface_fault(R"(, "transmittance": -0.1)"),
              HasSubstr("\"lid\".transmittance: is -0.1"));
  EXPECT_THAT(surface_fault(R"(, "transmittance": [0.5, 0.9], "reflectance": 0.2)"),
              HasSubstr("\"lid\".transmittance: and reflectance are more than 1 together"));
}

TEST_F(SceneReader, SkyIsReadAndItsFaultsNameTheirKey) {
  const auto with = [&](const std::string& sky) {
    return "{\"sky\": " + sky + ", \"surfaces\": [{\"reflectance\": 0, " + std::string(triangle) +
           "}]}";
  };
  const Scene grey = read(with(R"({"type": "overcast", "horizontal_illuminance": 7000})"));
  ASSERT_TRUE(grey.sky);
  EXPECT_NEAR(grey.sky->zenith_luminance.at(0), 7000.0 * 9.0 / (7.0 * 3.14159265358979), 0.05);
  // In the south-west, seen from north = x.
  const Scene clear = read(with(R"({"type": 12, "zenith": [1, 2], "north": [1, 0, 0],
      "sun": {"elevation": 30, "azimuth": 225, "illuminance": 5}, "ground_reflectance": 0.2})"));
  ASSERT_TRUE(clear.sky);
  EXPECT_EQ(clear.bands, 2);
  EXPECT_LT(glm::length(clear.sky->sun - Vec3(-std::sqrt(0.375), std::sqrt(0.375), 0.5)), 1e-9);
  EXPECT_THAT(clear.sky->sun_illuminance, ElementsAre(5.0, 5.0));
  EXPECT_THAT(clear.sky->ground_reflectance, ElementsAre(0.2, 0.2));
  EXPECT_TRUE(warnings_.empty()) << all_warnings(warnings_);
  for (const auto& [sky, what] :
       {std::pair{R"({"type": "blue", "zenith": 1})", "sky.type: is \"blue\""},
        {R"({"type": 16, "zenith": 1})", "sky.type: is 16"},
        {R"({"type": "overcast"})", "sky: has no brightness"},
        {R"({"type": "overcast", "zenith": 1, "horizontal_illuminance": 1})",
         "sky: has a zenith and a horizontal_illuminance"},
        {R"({"type": "clear", "zenith": 1})", "sky: of this type has no sun"},
        {R"({"type": "clear", "zenith": 1, "sun": {"elevation": 91, "azimuth": 0}})",
         "sky.sun.elevation: is 91"},
        {R"({"type": "clear", "zenith": 1, "sun": {"elevation": 9}})", "azimuth"},
        {R"({"type": "overcast", "zenith": 1, "ground_reflectance": 1})",
         "sky.ground_reflectance: is 1, outside [0, 1)"},
        {R"({"type": "overcast", "zenith": 1, "north": [0, 0, 1],
             "sun": {"elevation": 9, "azimuth": 0}})",
         "sky.north: points up"}})
    EXPECT_THAT(fault(with(sky)), HasSubstr(what)) << sky;
}

TEST_F(SceneReader, FaultsNameTheirKey) {
  EXPECT_THAT(surface_fault(R"(, "reflectance": [0.1, 1.2])"),
              HasSubstr("surfaces[1] \"lid\".reflectance[1]: is 1.2"));
  EXPECT_THAT(surface_fault(R"(, "reflectance": 1)"),
              HasSubstr("surfaces[1] \"lid\".reflectance: is 1, outside [0, 1)"));
  EXPECT_THAT(surface_fault(R"(, "reflectance": -0.1)"), HasSubstr("\"lid\".reflectance: is -0.1"));
  EXPECT_THAT(surface_fault(R"(, "exitance": [-3])"), HasSubstr("\"lid\".exitance[0]: is -3"));
  EXPECT_THAT(surface_fault(R"(, "exitance": "bright")"),
              HasSubstr("\"lid\".exitance: is \"bright\""));
  EXPECT_THAT(surface_fault(R"(, "exitance": 1e999)"), HasSubstr("\"lid\".exitance: is \"1e999\""));
  EXPECT_THAT(surface_fault(R"(, "reflectance": [])"),
              HasSubstr("\"lid\".reflectance: is an empty list"));
  EXPECT_THAT(surface_fault(R"(, "two_sided": 1)"), HasSubstr("\"lid\".two_sided: is 1"));
  EXPECT_THAT(surface_fault(R"(, "object": 4)"), HasSubstr("\"lid\".object: is 4"));
  EXPECT_THAT(fault(R"({"surfaces": [{"vertices": [[0,0,0],[1,0,0]]}]})"),
              HasSubstr("surfaces[0].vertices: has 2 points"));
  EXPECT_THAT(fault(R"({"surfaces": [{"vertices": [[0,0,0],[1,0,0],[1,2]]}]})"),
              HasSubstr("surfaces[0].vertices[2]: is [1,2]"));
  EXPECT_THAT(fault(R"({"surfaces": [{"vertices": [[0,0,0],[1,null,0],[1,2,3]]}]})"),
              HasSubstr("surfaces[0].vertices[1][1]: is null"));
  EXPECT_THAT(fault(R"({"surfaces": [{"name": "x"}]})"),
              HasSubstr("surfaces[0]: has no \"vertices\""));
  EXPECT_THAT(fault(R"({"surfaces": [7]})"), HasSubstr("surfaces[0]: is 7, not an object"));
}

TEST_F(SceneReader, FaultsOfTheWholeScene) {
  const std::string one = ", \"surfaces\": [{" + std::string(triangle) + "}]}";
  EXPECT_THAT(fault("[1, 2]"), HasSubstr("top level: is not an object"));
  EXPECT_THAT(fault("{}"), HasSubstr("has no \"surfaces\""));
  EXPECT_THAT(fault(R"({"surfaces": []})"), HasSubstr("surfaces: is an empty list"));
  EXPECT_THAT(fault(R"({"surfaces": {}})"), HasSubstr("surfaces: is {}, not a list"));
  EXPECT_THAT(fault("{\"format\": \"gltf\"" + one), HasSubstr("format: is \"gltf\""));
  EXPECT_THAT(fault("{\"version\": 2" + one), HasSubstr("version: is 2"));
  EXPECT_THAT(fault("{\"units\": \"furlong\"" + one), HasSubstr("units: is \"furlong\""));
  EXPECT_THAT(fault("{\"exitanceUnits\": \"lux\"" + one), HasSubstr("exitanceUnits: is \"lux\""));
  EXPECT_THAT(fault("{\"lights\": [{\"type\": \"sun\", \"p\": [0,0,0], \"intensity\": 1}]" + one),
              HasSubstr("lights[0].type: is \"sun\""));
  EXPECT_THAT(fault("{\"lights\": [{\"type\": \"point\", \"p\": [0,0,0]}]" + one),
              HasSubstr("lights[0]: has no \"intensity\""));
  EXPECT_THAT(fault("{\"probes\": [{\"p\": [0,0,0], \"n\": [0,0,0]}]" + one),
              HasSubstr("probes[0].n: has no length"));
}

TEST_F(SceneReader, BandCountsMustAgree) {
  const std::string text =
      fault("{\"surfaces\": [{\"reflectance\": [0.1, 0.2, 0.3], " + std::string(triangle) +
            "}, {\"exitance\": [1, 2], " + triangle + "}]}");
  EXPECT_THAT(text, AllOf(HasSubstr("surfaces[1].exitance: has 2 bands"),
                          HasSubstr("surfaces[0].reflectance has 3")));
}

TEST_F(SceneReader, FilesThatAreNoScene) {
  EXPECT_THAT(input_error([&] { read_scene(folder_.file("none.json"), warnings_); }),
              HasSubstr("does not exist"));
  EXPECT_THAT(input_error([&] { read_scene(folder_.file(""), warnings_); }),
              HasSubstr("is a directory"));
  EXPECT_THAT(fault(""), HasSubstr("file: is empty"));
}

TEST_F(SceneReader, SyntaxErrorsNameLineAndColumn) {
  EXPECT_THAT(fault("{\"surfaces\": [\n  {\"name\" \"x\"}]}"),
              HasSubstr("line 2:13: not valid JSON"));
  EXPECT_THAT(fault("{\"surfaces\": [\n\n"),
              AllOf(HasSubstr("line 3:1"), HasSubstr("ends too early")));
  EXPECT_THAT(fault("\x89PNG"), HasSubstr("line 1:1: not valid JSON"));
}

TEST_F(SceneReader, NumbersThatJsonCannotHoldAreRefusedByTheirKey) {
  const auto refused = [&](const std::string& name) {
    return input_error([&] { read_scene(test_data("refused/" + name), warnings_); });
  };
  EXPECT_THAT(refused("nan_vertex.json"),
              HasSubstr("surfaces[0] \"floor\".vertices[0][0]: is \"NaN\""));
  EXPECT_THAT(refused("inf_exitance.json"),
              HasSubstr("surfaces[9] \"light\".exitance[0]: is \"Infinity\""));
  EXPECT_THAT(refused("negative_exitance.json"),
              HasSubstr("surfaces[9] \"light\".exitance[0]: is -1"));
  EXPECT_THAT(refused("rho_1.json"),
              HasSubstr("surfaces[0] \"floor\".reflectance[0]: is 1.0, outside [0, 1)"));
  EXPECT_THAT(refused("rho_1p2.json"), HasSubstr("is 1.2"));
  EXPECT_THAT(refused("rho_negative.json"), HasSubstr("is -0.1"));
  // The same word in a name is only a name.
  const Scene scene =
      read("{\"surfaces\": [{\"name\": \"NaN \\\" Infinity\", " + std::string(triangle) + "}]}");
  EXPECT_EQ(scene.surfaces[0].name, "NaN \" Infinity");
}

TEST_F(SceneReader, EveryTruncationOfASceneIsOneClearError) {
  std::ifstream in(test_data("lamp_on_ceiling_plane.json"));
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t length = 1; length + 3 < text.size(); length += 37) {
    EXPECT_THAT(fault(text.substr(0, length)), HasSubstr("line ")) << length;
  }
}

TEST_F(SceneReader, ARealBuildingIsReadFast) {
  const auto start = std::chrono::steady_clock::now();
  const Scene scene = read_scene(source_file("scenes/duplex.json"), warnings_);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(scene.surfaces.size(), 9411u);
  EXPECT_EQ(scene.unit, ExitanceUnit::lumen_per_m2);
#ifdef NDEBUG
  constexpr double longest_s = 2.0;  // 0.07 s on an idle machine
#else
  constexpr double longest_s = 60.0;  // with sanitizers on a busy machine
#endif
  EXPECT_LT(took.count(), longest_s);
}

TEST_F(SceneReader, HashFollowsTheBytes) {
  const std::string text = "{\"surfaces\": [{" + std::string(triangle) + "}]}";
  EXPECT_EQ(read(text).hash, read(text).hash);
  EXPECT_NE(read(text).hash, read(text + " ").hash);
}

TEST_F(SceneReader, RoomsAreReadInMetres) {
  const Scene scene = read(
      R"({"units": "cm", "rooms": [
          {"name": 101, "longName": "Office", "storey": "EG", "bbox": [[0, 0, 0], [400, 300, 250]],
           "floorArea": 120000, "required_lx": 500},
          {"name": "l", "outline": [[0, 0], [0, 200], [200, 200], [200, 0]], "z": [0, 300]}],
          "surfaces": [{)" +
      std::string(triangle) + "}]}");
  ASSERT_EQ(scene.building.rooms.size(), 2u);
  const BuildingRoom& office = scene.building.rooms[0];
  EXPECT_EQ(office.name, "101");
  EXPECT_EQ(office.long_name, "Office");
  EXPECT_EQ(office.storey, "EG");
  EXPECT_DOUBLE_EQ(office.box.hi.z, 2.5);
  EXPECT_DOUBLE_EQ(office.floor_area_m2, 12.0);
  EXPECT_DOUBLE_EQ(office.required_lx, 500.0);
  const BuildingRoom& other = scene.building.rooms[1];
  // Its outline ran clockwise.
  EXPECT_EQ(other.outline, (std::vector<Vec2>{{2, 0}, {2, 2}, {0, 2}, {0, 0}}));
  EXPECT_DOUBLE_EQ(other.box.hi.z, 3.0);
}

}  // namespace
}  // namespace enfilade
