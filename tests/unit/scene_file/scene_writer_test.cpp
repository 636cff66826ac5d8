#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/random.hpp"
#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

TEST(SceneWriter, RoundTripIsExact) {
  Random random(3);
  Scene scene;
  scene.bands = 2;
  scene.unit = ExitanceUnit::lumen_per_m2;
  for (int i = 0; i < 50; ++i) {
    Surface s;
    for (int k = 0; k < 3 + i % 4; ++k) {
      s.vertices.emplace_back(random.uniform() / 3.0, 1e6 * random.uniform(),
                              -1e-7 * random.uniform());
    }
    s.reflectance = {random.uniform(), 0.0};
    s.exitance = {1e9 * random.uniform(), 0.1};
    s.name = i % 2 == 0 ? "" : "name \"" + std::to_string(i) + "\" \n\xc3\xa9";
    s.object = i % 3 == 0 ? "" : "object";
    s.two_sided = i % 5 == 0;
    scene.surfaces.push_back(s);
  }
  scene.lights.push_back({{1.0 / 3.0, 2, 3}, {4, 5}});
  scene.probes.push_back({{0.1, 0.2, 0.3}, {0, 1, 0}});
  const TemporaryFolder folder;
  const std::string path = folder.file("scene.json");
  write_scene(scene, path);
  Warnings warnings;
  const Scene back = read_scene(path, warnings);
  EXPECT_TRUE(warnings.empty()) << all_warnings(warnings);
  EXPECT_EQ(back.bands, 2);
  EXPECT_EQ(back.unit, scene.unit);
  ASSERT_EQ(back.surfaces.size(), scene.surfaces.size());
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    EXPECT_EQ(back.surfaces[i].vertices, scene.surfaces[i].vertices);
    EXPECT_EQ(back.surfaces[i].reflectance, scene.surfaces[i].reflectance);
    EXPECT_EQ(back.surfaces[i].exitance, scene.surfaces[i].exitance);
    EXPECT_EQ(back.surfaces[i].name, scene.surfaces[i].name);
    EXPECT_EQ(back.surfaces[i].object, scene.surfaces[i].object);
    EXPECT_EQ(back.surfaces[i].two_sided, scene.surfaces[i].two_sided);
  }
  EXPECT_EQ(back.lights.at(0).p, scene.lights[0].p);
  EXPECT_EQ(back.lights[0].intensity, scene.lights[0].intensity);
  EXPECT_EQ(back.probes.at(0).p, scene.probes[0].p);
  EXPECT_EQ(back.probes[0].n, scene.probes[0].n);
}

TEST(SceneWriter, ReplacesAFileAndLeavesNothingElse) {
  const TemporaryFolder folder;
  const std::string path = folder.write("out.txt", "old content that is longer");
  write_file_atomically(path, "new");
  std::ifstream in(path);
  EXPECT_EQ(std::string((std::istreambuf_iterator<char>(in)), {}), "new");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(SceneWriter, AFolderThatIsMissingBreaksTheRun) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_file_atomically(folder.file("none/out.txt"), "x"), RunError);
}

TEST(ProbeFile, AnswersKeepWhatTheFileHeld) {
  const TemporaryFolder folder;
  const std::string source = folder.write("p.json", R"({"author": "me", "units": "mm",
    "probes": [{"p": [1000, 0, 0], "n": [0, 0, 3], "label": "desk"}, {"p": [0, 0, 0], "n": [1, 0, 0]}]})");
  const ProbeFile points = read_probes(source);
  const std::vector<Probe>& probes = points.probes;
  ASSERT_EQ(probes.size(), 2u);
  EXPECT_EQ(probes[0].p, Vec3(1, 0, 0));
  EXPECT_EQ(probes[0].n, Vec3(0, 0, 1));
  const std::string path = folder.file("a.json");
  write_probe_answers(points, path, {{{1.5, 2.5}, {0.1, 0.2}}, {{0.0, 1e-9}, {0.0, 0.0}}}, "gather",
                      ExitanceUnit::lumen_per_m2);
  const auto answer = nlohmann::json::parse(std::ifstream(path));
  EXPECT_EQ(answer["author"], "me");
  EXPECT_EQ(answer["from"], "gather");
  EXPECT_EQ(answer["unit"], "lx");
  EXPECT_EQ(answer["probes"][0]["label"], "desk");
  EXPECT_EQ(answer["probes"][0]["E"], (std::vector<double>{1.5, 2.5}));
  EXPECT_EQ(answer["probes"][0]["error"], (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(answer["probes"][1]["E"], (std::vector<double>{0.0, 1e-9}));
}

TEST(ProbeFile, ProbesOfASceneLeaveItsGeometryBehind) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.json");
  write_probe_answers(read_probes(test_data("thin_gap.json")), path,
                      {{{1.0, 1.0, 1.0}, {0.1, 0.1, 0.1}}}, "patches", ExitanceUnit::watt_per_m2);
  const auto answer = nlohmann::json::parse(std::ifstream(path));
  EXPECT_FALSE(answer.contains("surfaces"));
  EXPECT_EQ(answer["probes"][0]["surface"], "b");
  EXPECT_EQ(answer["unit"], "W/m2");
}

TEST(ProbeFile, FaultsNameTheirKey) {
  const TemporaryFolder folder;
  const auto fault = [&](const std::string& text) {
    return input_error([&] { read_probes(folder.write("p.json", text)); });
  };
  EXPECT_THAT(fault("{}"), HasSubstr("top level: has no \"probes\""));
  EXPECT_THAT(fault(R"({"probes": []})"), HasSubstr("probes: is empty"));
  EXPECT_THAT(fault("[]"), HasSubstr("top level: is [], not an object"));
  EXPECT_THAT(fault(R"({"probes": [{"p": [0,0,0]}]})"), HasSubstr("probes[0]: has no \"n\""));
  EXPECT_THAT(fault(R"({"probes": [{"p": [0,0,NaN], "n": [0,0,1]}]})"),
              HasSubstr("probes[0].p[2]: is \"NaN\""));
}

}  // namespace
}  // namespace enfilade
