#include "report/export/solution_glb.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

using test::LitRooms;

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

nlohmann::json json_of(const std::string& glb) {
  return nlohmann::json::parse(glb.substr(20, word(glb, 12)));
}

LitRooms sloped_light() {
  LitRooms rooms(2, 3);
  rooms.subdivide(0.4);
  rooms.set_irradiance([](const Vec3& p) { return 10.0 + p.x; });
  return rooms;
}

TEST(SolutionGlb, ChunksHaveTheirLengths) {
  const std::string glb = solution_glb(sloped_light().solved());
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word(glb, 4), 2u);
  EXPECT_EQ(word(glb, 8), glb.size());
  const std::uint32_t json_bytes = word(glb, 12);
  EXPECT_EQ(json_bytes % 4, 0u);
  EXPECT_EQ(word(glb, 20 + json_bytes) % 4, 0u);
  EXPECT_EQ(28 + json_bytes + word(glb, 20 + json_bytes), glb.size());
}

TEST(SolutionGlb, SaysWhatItHolds) {
  const auto json = json_of(solution_glb(sloped_light().solved()));
  EXPECT_EQ(json["asset"]["version"], "2.0");
  EXPECT_EQ(json["asset"]["extras"]["irradianceUnit"], "lx");
  EXPECT_EQ(json["extensionsUsed"][0], "KHR_materials_unlit");
  EXPECT_TRUE(json["materials"][0]["extensions"].contains("KHR_materials_unlit"));
  EXPECT_EQ(json["meshes"].size(), 5u);  // two rooms, two lamps, the shell
  for (const auto& accessor : json["accessors"]) {
    const auto& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    EXPECT_LE(accessor["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>());
    EXPECT_EQ(accessor["byteOffset"].get<std::size_t>() % 4, 0u);
    EXPECT_GT(accessor["count"].get<std::size_t>(), 0u);
  }
}

/// The importer's own idea of where each mesh stands.
void collect(const aiNode* node, const aiMatrix4x4& parent,
             std::vector<std::pair<unsigned, aiMatrix4x4>>& found) {
  const aiMatrix4x4 here = parent * node->mTransformation;
  for (unsigned i = 0; i < node->mNumMeshes; ++i) found.emplace_back(node->mMeshes[i], here);
  for (unsigned i = 0; i < node->mNumChildren; ++i) collect(node->mChildren[i], here, found);
}

TEST(SolutionGlb, AnImporterFindsTheBuilding) {
  const LitRooms rooms = sloped_light();
  const std::string glb = solution_glb(rooms.solved());
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFileFromMemory(glb.data(), glb.size(), aiProcess_ValidateDataStructure, "glb");
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  std::vector<std::pair<unsigned, aiMatrix4x4>> meshes;
  collect(scene->mRootNode, aiMatrix4x4(), meshes);
  ASSERT_EQ(meshes.size(), rooms.clusters.size());
  for (const auto& [index, transform] : meshes) {
    const aiMesh& mesh = *scene->mMeshes[index];
    const auto cluster =
        std::find_if(rooms.clusters.begin(), rooms.clusters.end(),
                     [&](const Cluster& c) { return c.object == mesh.mName.C_Str(); });
    ASSERT_NE(cluster, rooms.clusters.end()) << mesh.mName.C_Str();
    double area = 0.0;
    Box box;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      ASSERT_EQ(mesh.mFaces[f].mNumIndices, 3u);
      Polygon triangle;
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D v = transform * mesh.mVertices[mesh.mFaces[f].mIndices[k]];
        triangle.push_back({v.x, -v.z, v.y});  // y up back to z up
        box.add(triangle.back());
      }
      area += area_m2(triangle);
    }
    EXPECT_NEAR(area, cluster->area_m2, 1e-4 * cluster->area_m2) << mesh.mName.C_Str();
    EXPECT_NEAR(glm::length(box.lo - cluster->bounds.lo), 0.0, 1e-4);
    EXPECT_NEAR(glm::length(box.hi - cluster->bounds.hi), 0.0, 1e-4);
  }
}

TEST(SolutionGlb, ColoursAreTheToneMappedLight) {
  const LitRooms rooms = sloped_light();
  ToneConfig tone;
  tone.curve = ToneConfig::Curve::linear;
  tone.exposure = 0.01;
  const std::string glb = solution_glb(rooms.solved(), tone);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFileFromMemory(glb.data(), glb.size(), 0, "glb");
  ASSERT_NE(scene, nullptr);
  std::vector<std::pair<unsigned, aiMatrix4x4>> meshes;
  collect(scene->mRootNode, aiMatrix4x4(), meshes);
  for (const auto& [index, transform] : meshes) {
    const aiMesh& mesh = *scene->mMeshes[index];
    ASSERT_TRUE(mesh.HasVertexColors(0));
    const std::string name = mesh.mName.C_Str();
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const double x = (transform * mesh.mVertices[i]).x;
      double expected = 0.01 * 0.5 * (10.0 + x);  // half of the irradiance is reflected
      if (name.starts_with("lamp")) expected = 1.0;
      if (name == "shell") expected = 0.0;
      EXPECT_NEAR(mesh.mColors[0][i].r, expected, 2e-4) << name;
    }
  }
}

TEST(SolutionGlb, NeighbouringPatchesShareTheirCorners) {
  LitRooms rooms;
  const auto positions = [](const std::string& glb) {
    std::size_t n = 0;
    const auto json = json_of(glb);
    for (const auto& a : json["accessors"]) {
      if (a["type"] == "VEC3") n += a["count"].get<std::size_t>();
    }
    return n;
  };
  EXPECT_EQ(positions(solution_glb(rooms.solved())), 6u * 4 + 4 + 6 * 4);
  rooms.subdivide(
      12.0);  // floor and ceiling (20 m2), the long walls (15 m2), as the shell's: two halves each
  EXPECT_EQ(positions(solution_glb(rooms.solved())), 4u * 6 + 2 * 4 + 4 + 5 * 6 + 1 * 6);
}

}  // namespace
}  // namespace enfilade
