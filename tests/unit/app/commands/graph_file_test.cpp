#include "app/commands/graph_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace enfilade {
namespace {

TEST(GraphFile, NamesClustersTheirSurfacesAndEachPairOnce) {
  Prepared prepared;
  for (int i = 0; i < 3; ++i) {
    Cluster cluster;
    cluster.id = ClusterId(i);
    if (i < 2) cluster.cell = CellId(7);
    cluster.polygons = {{SurfaceId(5 - i), {}}, {SurfaceId(1), {}}, {SurfaceId(5 - i), {}}};
    prepared.clusters.push_back(cluster);
  }
  prepared.graph = ClusterGraph(3, {{2, 0}, {0, 1}, {1, 0}});
  const auto graph = nlohmann::json::parse(graph_json(prepared));
  EXPECT_EQ(graph["visible"], nlohmann::json::parse("[[0,1],[0,2]]"));
  EXPECT_EQ(graph["clusters"][0],
            nlohmann::json::parse(R"({"id": 0, "cell": 7, "surfaces": [1,5]})"));
  EXPECT_EQ(graph["clusters"][2]["cell"], -1);
}

TEST(GraphFile, NoClustersAreStillJson) {
  const auto graph = nlohmann::json::parse(graph_json(Prepared{}));
  EXPECT_TRUE(graph["clusters"].empty());
  EXPECT_TRUE(graph["visible"].empty());
}

}  // namespace
}  // namespace enfilade
