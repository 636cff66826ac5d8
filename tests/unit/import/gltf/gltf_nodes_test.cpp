#include "import/gltf/gltf_nodes.hpp"

#include "unit/import/gltf/gltf_model.hpp"

namespace enfilade {
namespace {

using test::area_of;
using test::GltfModel;
using ::testing::HasSubstr;

TEST(GltfNodes, AChainMayBeLongerThanAStackIsDeep) {
  constexpr std::size_t length = 100'000;
  GltfModel model;
  model.document["nodes"].clear();
  for (std::size_t i = 1; i < length; ++i)
    model.document["nodes"].push_back({{"children", {i}}, {"translation", {0, 1, 0}}});
  model.document["nodes"].push_back({{"mesh", 0}});
  const Scene scene = model.import();
  ASSERT_EQ(scene.surfaces.size(), 1u);
  EXPECT_NEAR(scene.surfaces[0].vertices[0].z, length - 1.0, 1e-6);
}

TEST(GltfNodes, WhatIsNoTreeIsRefused) {
  GltfModel model;
  model.document["nodes"] = {{{"children", {1, 1}}}, {{"mesh", 0}}};
  EXPECT_THAT(model.fault(),
              HasSubstr("nodes[0].children: names nodes[1], which has a parent already"));
  model.document["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
  EXPECT_THAT(model.fault(), HasSubstr("scenes[0].nodes: names nodes[0], which is a child"));
  model.document["nodes"] = {{{"children", {7}}}};
  EXPECT_THAT(model.fault(), HasSubstr("names 7, which is no node"));
}

TEST(GltfNodes, InstancesAreObjectsOfTheirOwn) {
  GltfModel model;
  const std::size_t places = model.accessor(std::vector<float>{0, 0, 0, 0, 5, 0}, 5126, "VEC3");
  const std::size_t sizes = model.accessor(std::vector<float>{1, 1, 1, 2, 2, 2}, 5126, "VEC3");
  const std::size_t turns =
      model.accessor(std::vector<std::int8_t>{0, 0, 0, 127, 127, 0, 0, 0}, 5120, "VEC4");
  model.document["accessors"].back()["normalized"] = true;
  auto& attributes =
      model.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes = {{"TRANSLATION", places}, {"SCALE", sizes}, {"ROTATION", turns}};
  const Scene scene = model.import();
  ASSERT_EQ(scene.surfaces.size(), 2u);
  EXPECT_NEAR(area_of(scene), 1.0 + 4.0, 1e-9);
  EXPECT_EQ(scene.surfaces[1].object, "square#2");
  EXPECT_NEAR(scene.surfaces[1].vertices[0].z, 5.0, 1e-9);
  EXPECT_NEAR(normal(scene.surfaces[1].vertices).z, -1.0, 1e-9);  // half a turn about x
  attributes["SCALE"] = 1;
  EXPECT_THAT(model.fault(), HasSubstr("EXT_mesh_gpu_instancing"));
}

TEST(GltfNodes, MirrorsKeepTheFrontAndHiddenNodesAreLeftOut) {
  GltfModel model;
  model.document["nodes"] = {
      {{"mesh", 0}, {"scale", {-2, 1, 1}}},
      {{"children", {2}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
      {{"mesh", 0}}};
  model.document["scenes"][0]["nodes"] = {0, 1};
  const Scene scene = model.import();
  ASSERT_EQ(scene.surfaces.size(), 1u);
  EXPECT_NEAR(normal(scene.surfaces[0].vertices).z, 1.0, 1e-9);
  EXPECT_NEAR(area_of(scene), 2.0, 1e-9);
}

}  // namespace
}  // namespace enfilade
