#include "import/gltf/gltf_import.hpp"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <numbers>

#include "unit/import/gltf/gltf_model.hpp"

namespace enfilade {
namespace {

using test::area_of;
using test::GltfModel;
using ::testing::HasSubstr;
using ::testing::Not;

using std::numbers::pi;

TEST(GltfImport, UnknownExtensionsAreToldAndRefusedWhereRequired) {
  GltfModel model;
  model.document["extensionsUsed"] = {"VENDOR_magic", "KHR_lights_punctual"};
  EXPECT_EQ(model.warnings().find("VENDOR_magic: extensions that are not carried out"), 0u);
  model.document["extensionsRequired"] = {"KHR_mesh_quantization", "VENDOR_magic"};
  EXPECT_THAT(model.fault(),
              HasSubstr("extensionsRequired: the extension \"VENDOR_magic\" is required"));
}

TEST(GltfImport, QuantizedPositions) {
  GltfModel model;
  const std::vector<std::int8_t> square{0, 0, 0, 0, 0, 0, 127, 0, 127, 0, 127, 0, 127, 0, 0, 0};
  model.primitive()["attributes"]["POSITION"] = model.accessor(square, 5120, "VEC4");
  auto& accessor = model.document["accessors"].back();
  accessor["type"] = "VEC3";
  model.document["bufferViews"].back()["byteStride"] = 4;
  accessor["normalized"] = true;
  EXPECT_NEAR(area_of(model.import()), 1.0, 1e-12);
  accessor["normalized"] = false;
  EXPECT_NEAR(area_of(model.import()), 127.0 * 127.0, 1e-9);
}

TEST(GltfImport, SparsePositions) {
  GltfModel model;
  const std::size_t at = model.view(std::vector<std::uint8_t>{2, 3});
  const std::size_t by = model.view(std::vector<float>{3, 0, 1, 3, 0, 0});
  model.document["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", at}, {"componentType", 5121}}},
      {"values", {{"bufferView", by}}}};
  EXPECT_NEAR(area_of(model.import()), 3.0, 1e-12);
  model.document["accessors"][0]["sparse"]["count"] = 3;
  EXPECT_THAT(model.fault(), HasSubstr("accessors[0]: reaches out of bufferViews[2]"));
}

TEST(GltfImport, StripsAndFansKeepTheirFront) {
  for (const int mode : {5, 6}) {
    GltfModel model;
    const std::vector<std::uint16_t> corners =
        mode == 5 ? std::vector<std::uint16_t>{1, 2, 0, 3} : std::vector<std::uint16_t>{0, 1, 2, 3};
    model.primitive()["mode"] = mode;
    model.primitive()["indices"] = model.accessor(corners, 5123, "SCALAR");
    const Scene scene = model.import();
    ASSERT_EQ(scene.surfaces.size(), 1u) << mode;
    EXPECT_NEAR(normal(scene.surfaces[0].vertices).z, 1.0, 1e-9) << mode;
  }
}

TEST(GltfImport, MeshoptAndDracoDecompress) {
  GltfModel model;
  const std::vector<float> doubled{0, 0, 0, 0, 0, 2, 2, 0, 2, 2, 0, 0};
  std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(4, 12));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), doubled.data(), 4, 12));
  const std::size_t source = model.view(packed);
  model.document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0},      {"byteOffset", model.document["bufferViews"][source]["byteOffset"]},
      {"byteStride", 12}, {"byteLength", packed.size()},
      {"count", 4},       {"mode", "ATTRIBUTES"}};
  model.document["extensionsRequired"] = {"EXT_meshopt_compression"};
  EXPECT_NEAR(area_of(model.import()), 4.0, 1e-6);

  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int position =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const float corners[3][3] = {{0, 0, 0}, {0, 0, 3}, {3, 0, 0}};
  builder.SetAttributeValuesForFace(position, draco::FaceIndex(0), corners[0], corners[1],
                                    corners[2]);
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::EncoderBuffer encoded;
  ASSERT_TRUE(draco::Encoder().EncodeMeshToBuffer(*mesh, &encoded).ok());
  const std::size_t view =
      model.view(std::vector<char>(encoded.data(), encoded.data() + encoded.size()));
  model.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view}, {"attributes", {{"POSITION", mesh->attribute(0)->unique_id()}}}};
  EXPECT_NEAR(area_of(model.import()), 4.5, 1e-6);
  model.document["bufferViews"][view]["byteLength"] = 20;
  EXPECT_THAT(model.fault(), HasSubstr("cannot be decompressed"));
}

TEST(GltfImport, AlphaAsItsModeSays) {
  const auto surfaces = [](const std::string& mode, double alpha) {
    GltfModel model;
    GltfModel::Json material = {
        {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, alpha}}}}};
    if (!mode.empty()) material["alphaMode"] = mode;
    model.material(material);
    return model.import().surfaces.size();
  };
  EXPECT_EQ(surfaces("", 0.0), 1u);
  EXPECT_EQ(surfaces("OPAQUE", 0.0), 1u);
  EXPECT_EQ(surfaces("BLEND", 0.4), 0u);
  EXPECT_EQ(surfaces("BLEND", 0.6), 1u);
  EXPECT_EQ(surfaces("MASK", 0.4), 0u);
  EXPECT_EQ(surfaces("MASK", 0.6), 1u);
}

TEST(GltfImport, MaterialsByTheirExtensions) {
  GltfModel model;
  model.material({{"name", "first"}});  // not the first that is in use
  model.material(
      {{"emissiveFactor", {1, 0.5, 0}},
       {"extensions",
        {{"KHR_materials_emissive_strength", {{"emissiveStrength", 20}}},
         {"KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.1, 0.2, 0.3, 1}}}}}}});
  const Surface surface = model.import().surfaces.at(0);
  EXPECT_NEAR(surface.exitance[0], 20.0 * pi, 1e-9);
  EXPECT_NEAR(surface.exitance[1], 10.0 * pi, 1e-9);
  EXPECT_NEAR(surface.reflectance[2], 0.3, 1e-9);
  EXPECT_THAT(model.warnings(), Not(HasSubstr("base colour")));  // of "first", which is not in use
  model.material({{"pbrMetallicRoughness", {{"baseColorFactor", {0.9, 0.5, 0.2, 1}}}},
                  {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.9}}}}}});
  const Surface pane = model.import().surfaces.at(0);
  ASSERT_EQ(pane.transmittance.size(), 3u);
  EXPECT_NEAR(pane.transmittance[0], 0.81, 1e-9);
  EXPECT_NEAR(pane.transmittance[2], 0.18, 1e-9);
  EXPECT_NEAR(pane.reflectance[1], 0.05, 1e-9);
}

TEST(GltfImport, VertexColoursCountByTriangle) {
  GltfModel model;
  const std::vector<std::uint8_t> colours{255, 255, 255, 255, 0,   0,   0,   255,
                                          255, 255, 255, 255, 255, 255, 255, 255};
  model.material({{"pbrMetallicRoughness", {{"baseColorFactor", {0.6, 0.6, 0.6, 1}}}}});
  model.primitive()["attributes"]["COLOR_0"] = model.accessor(colours, 5121, "VEC4");
  model.document["accessors"].back()["normalized"] = true;
  const Scene scene = model.import();
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_NEAR(scene.surfaces[0].reflectance[0], 0.4, 1e-3);
  EXPECT_NEAR(scene.surfaces[1].reflectance[0], 0.6, 1e-3);
}

TEST(GltfImport, TexturesCountByTheirMeanAndMayBeMissing) {
  GltfModel model;
  model.document["textures"] = {{{"source", 0}}};
  const std::string pixel = std::string("P6 1 1 255\n") + "\x80\x80\x80";
  model.document["images"] = {{{"uri", "data:image/x;base64," + GltfModel::base64(pixel)}}};
  model.material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  EXPECT_NEAR(model.import().surfaces.at(0).reflectance[0], 0.2158605, 1e-6);
  for (const char* uri : {"gone.png", "../../etc/passwd"}) {
    model.document["images"] = {{{"uri", uri}}};
    EXPECT_THAT(model.warnings(), HasSubstr("images[0] \"" + std::string(uri) + "\": is missing"));
    EXPECT_NEAR(model.import().surfaces.at(0).reflectance[0], 0.5, 1e-12);  // not white
  }
}

TEST(GltfImport, LampsInManyNodesAndOfAllKinds) {
  GltfModel model;
  model.document["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 10}},
      {{"type", "spot"},
       {"intensity", 10},
       {"spot", {{"innerConeAngle", pi / 2}, {"outerConeAngle", pi / 2}}}},
      {{"type", "directional"}}};
  for (const int light : {0, 0, 1, 2}) {
    model.document["nodes"].push_back(
        {{"name", "lamp"},
         {"translation", {0, 2, light}},
         {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    model.document["scenes"][0]["nodes"].push_back(model.document["nodes"].size() - 1);
  }
  Warnings warnings;
  const Scene scene = model.import(warnings);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_NEAR(scene.lights[1].intensity[0], 10.0, 1e-12);
  EXPECT_NEAR(scene.lights[2].intensity[0], 5.0, 1e-9);  // half of all directions
  EXPECT_NEAR(scene.lights[2].p.z, 2.0, 1e-12);
  ASSERT_TRUE(scene.lights[2].cone);
  EXPECT_NEAR(scene.lights[2].cone->outer, pi / 2, 1e-12);
  // Lamps shine along their nodes' -z, which is +y of a scene with z up.
  EXPECT_LT(glm::length(scene.lights[2].frame.aim - Vec3(0, 1, 0)), 1e-12);
  EXPECT_NEAR(relative_intensity(scene.lights[2], {0.3, 1, 0}), 2.0, 1e-3);
  EXPECT_EQ(relative_intensity(scene.lights[2], {0, -1, 0}), 0.0);
  EXPECT_THAT(all_warnings(warnings), HasSubstr("light of type \"directional\": left out"));
}

TEST(GltfImport, FaultsNameTheirKey) {
  const auto fault = [](auto change) {
    GltfModel model;
    change(model.document);
    return model.fault();
  };
  using Json = GltfModel::Json;
  EXPECT_THAT(fault([](Json& d) { d["asset"]["version"] = "1.0"; }),
              HasSubstr("asset.version: is \"1.0\""));
  EXPECT_THAT(fault([](Json& d) { d["asset"]["minVersion"] = "2.1"; }),
              HasSubstr("asset.minVersion: asks for a reader of glTF \"2.1\""));
  EXPECT_THAT(
      fault([](Json& d) {
        d["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", -1}}};
        d["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
      }),
      HasSubstr("lights[0]: has an intensity or a colour below zero"));
  EXPECT_THAT(fault([](Json& d) { d["accessors"][0]["count"] = 4e9; }),
              HasSubstr("too many numbers"));
  EXPECT_THAT(fault([](Json& d) { d["accessors"][0]["count"] = 5; }), HasSubstr("reaches out of"));
  EXPECT_THAT(fault([](Json& d) { d["accessors"][0]["componentType"] = 7; }),
              HasSubstr("accessors[0].componentType"));
  EXPECT_THAT(fault([](Json& d) { d["bufferViews"][0]["byteOffset"] = 900; }),
              HasSubstr("bufferViews[0]: reaches to byte"));
  EXPECT_THAT(fault([](Json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }),
              HasSubstr("names accessors[9], which is not there"));
  EXPECT_THAT(fault([](Json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 1; }),
              HasSubstr("not 3"));
  EXPECT_THAT(fault([](Json& d) { d["nodes"][0]["mesh"] = "x"; }),
              HasSubstr("nodes[0].mesh: is \"x\""));
  EXPECT_THAT(fault([](Json& d) { d["meshes"] = 3; }), HasSubstr("meshes: is not a list"));
  EXPECT_THAT(fault([](Json& d) { d["nodes"][0].erase("mesh"); }), HasSubstr("holds no polygons"));
}

}  // namespace
}  // namespace enfilade
