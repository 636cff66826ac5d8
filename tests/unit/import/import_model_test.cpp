#include <bit>
#include <nlohmann/json.hpp>
#include <numbers>

#include "import/import_model.hpp"
#include "unit/scene/test_scenes.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

using std::numbers::pi;

void expect_lamp_scene(const Scene& scene, const std::string& warnings) {
  EXPECT_EQ(scene.bands, 3);
  EXPECT_EQ(scene.unit, ExitanceUnit::lumen_per_m2);
  ASSERT_EQ(scene.surfaces.size(), 2u);  // two triangles each, joined to one rectangle
  const Surface& floor = scene.surfaces[0];
  EXPECT_EQ(floor.object, "floor");
  EXPECT_EQ(floor.vertices.size(), 4u);
  EXPECT_NEAR(area_m2(floor.vertices), 6.0, 1e-6);
  EXPECT_NEAR(normal(floor.vertices).z, 1.0, 1e-6);  // y-up became z-up
  EXPECT_NEAR(bounds(floor.vertices).hi.y, 3.0, 1e-6);
  EXPECT_NEAR(floor.reflectance[0], 0.95, 1e-6);
  EXPECT_NEAR(floor.reflectance[1], 0.5, 1e-6);
  EXPECT_NEAR(floor.reflectance[2], 0.25, 1e-6);
  EXPECT_FALSE(floor.two_sided);

  const Surface& panel = scene.surfaces[1];
  EXPECT_NEAR(normal(panel.vertices).z, -1.0, 1e-6);  // turned by half a turn about x
  EXPECT_NEAR(area_m2(panel.vertices), 0.75, 1e-6);
  EXPECT_NEAR(bounds(panel.vertices).lo.z, 2.5, 1e-6);
  EXPECT_TRUE(panel.two_sided);
  EXPECT_NEAR(panel.exitance[0], pi * 50.0 * 1.0, 1e-4);
  EXPECT_NEAR(panel.exitance[2], pi * 50.0 * 0.6, 1e-4);

  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_LT(glm::length(scene.lights[0].p - Vec3(1, 1.5, 2)), 1e-6);
  EXPECT_NEAR(scene.lights[0].intensity[0], 80.0, 1e-4);
  EXPECT_NEAR(scene.lights[0].intensity[2], 20.0, 1e-4);
  EXPECT_THAT(warnings, HasSubstr("materials[0] \"white\": base colour above 0.95"));
}

TEST(ImportModel, GltfWithEmissionAndALamp) {
  Warnings warnings;
  const Scene scene = import_model(test_data("lamp.gltf"), warnings);
  expect_lamp_scene(scene, all_warnings(warnings));
}

std::string little_endian(std::size_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
  return text;
}

std::string glb_chunk(std::string bytes, const std::string& kind, char padding) {
  while (bytes.size() % 4 != 0) bytes += padding;
  return little_endian(bytes.size(), 4) + kind + bytes;
}

TEST(ImportModel, TheSameAsGlbThroughReadScene) {
  nlohmann::json document = nlohmann::json::parse(std::ifstream(test_data("lamp.gltf")));
  document["buffers"][0].erase("uri");
  std::string buffer;
  for (const float x : {0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 2.f, 0.f, -3.f, 0.f, 0.f, -3.f}) {
    buffer += little_endian(std::bit_cast<std::uint32_t>(x), 4);
  }
  for (const unsigned i : {0u, 1u, 2u, 0u, 2u, 3u}) buffer += little_endian(i, 2);
  const std::string chunks =
      glb_chunk(document.dump(), "JSON", ' ') + glb_chunk(buffer, std::string("BIN\0", 4), '\0');
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "lamp.glb", "glTF" + little_endian(2, 4) + little_endian(12 + chunks.size(), 4) + chunks);
  Warnings warnings;
  const Scene scene = read_scene_or_model(path, warnings);
  expect_lamp_scene(scene, all_warnings(warnings));
}

TEST(ImportModel, ImportedSceneIsWrittenAndReadBack) {
  Warnings warnings;
  const Scene scene = import_model(test_data("lamp.gltf"), warnings);
  const TemporaryFolder folder;
  write_scene(scene, folder.file("s.json"));
  Warnings none;
  const Scene back = read_scene(folder.file("s.json"), none);
  EXPECT_TRUE(none.empty()) << all_warnings(none);
  EXPECT_EQ(back.surfaces[1].exitance, scene.surfaces[1].exitance);
  EXPECT_EQ(back.lights[0].p, scene.lights[0].p);
}

TEST(ImportModel, WhatCannotBeImportedIsAClearError) {
  const TemporaryFolder folder;
  Warnings warnings;
  const auto fault = [&](const std::string& name, const std::string& text) {
    return input_error([&] { import_model(folder.write(name, text), warnings); });
  };
  EXPECT_THAT(fault("a.skp", "x"), HasSubstr("is of no kind that can be imported"));
  EXPECT_THAT(fault("a.glb", "glTF rubbish"), HasSubstr("is cut off within its header"));
  EXPECT_THAT(fault("a.gltf", "{}"), HasSubstr("a.gltf: "));
  EXPECT_THAT(fault("a.obj", ""), HasSubstr("is empty"));
  EXPECT_THAT(fault("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), HasSubstr("a.obj: "));
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n";
  EXPECT_THAT(fault("a.obj", corners + "f 1 1 1\n"), HasSubstr("holds no shape"));
  for (const double scale : {1e12, 1e100, 1e160, 1e300}) {
    ImportOptions options;
    options.scale = scale;
    const std::string model = folder.write("far.obj", corners + "f 1 2 3 4\n");
    EXPECT_THAT(input_error([&] { import_model({model}, options, warnings); }),
                HasSubstr("lies beyond 1e9 m"))
        << scale;
  }
  EXPECT_THAT(input_error([&] { import_model(folder.file("none.obj"), warnings); }),
              HasSubstr("does not exist"));
}

TEST(ImportModel, OnlyRadianceFilesMakeOneModelTogether) {
  const TemporaryFolder folder;
  Warnings warnings;
  const std::string materials = folder.write("m.rad", "void plastic g 0 0 5 .5 .5 .5 0 0\n");
  const std::string room = folder.write("r.rad", "g polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n");
  EXPECT_EQ(import_model({materials, room}, {}, warnings).surfaces.size(), 1u);
  EXPECT_THAT(input_error([&] {
                import_model({test_data("lamp.gltf"), test_data("lamp.gltf")}, {}, warnings);
              }),
              HasSubstr("is a second model"));
}

TEST(ImportModel, WhatASceneCannotHoldIsRefused) {
  const TemporaryFolder folder;
  Warnings warnings;
  const std::string face = "v 0 0 0\nv 1 0 0\nv 0 1 2e9\nusemtl l\nf 1 2 3\n";
  EXPECT_THAT(input_error([&] { import_model(folder.write("far.obj", face), warnings); }),
              HasSubstr("has a point that lies beyond 1e9 m"));
  folder.write("l.mtl", "newmtl l\nKd 0 0 0\nKe 1e31 0 0\n");
  EXPECT_THAT(input_error([&] {
                import_model(
                    folder.write("bright.obj",
                                 "mtllib l.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl l\nf 1 2 3\n"),
                    warnings);
              }),
              HasSubstr("is more than numbers can carry on with"));
}

TEST(ImportModel, EachThingIsToldOnce) {
  const TemporaryFolder folder;
  Warnings warnings;
  import_model(folder.write("m.obj",
                            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\no a\nf 1 2 3 4\nf 1 2 3 4\n"
                            "f 1 2 4 3\n"),
               warnings);
  EXPECT_EQ(all_warnings(warnings),
            "faces before any usemtl: have no material: reflectance taken as 0.5\n"
            "\"a\": polygon that crosses itself: left out\n");
}

}  // namespace
}  // namespace enfilade
