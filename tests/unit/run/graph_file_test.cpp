#include "run/graph_file.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

TEST(GraphFile, ComesBackAsWritten) {
  const std::string path = testing::TempDir() + "/graph.txt";
  const ClusterGraph graph(5, {{0, 3}, {3, 1}, {4, 3}, {0, 1}});
  write_graph(graph, path);
  const ClusterGraph back = read_graph(path);
  ASSERT_EQ(back.size(), 5u);
  EXPECT_EQ(back.edges(), 4u);
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = 0; j < 5; ++j)
      EXPECT_EQ(back.has_edge(i, j), graph.has_edge(i, j)) << i << " " << j;
  }
}

TEST(GraphFile, ACutOrAlteredFileIsRefused) {
  const std::string path = testing::TempDir() + "/bad_graph.txt";
  for (const char* text : {"", "enfilade-graph 1 2 1\ncluster-0 0 1\n",
                           "enfilade-graph 1 2 1\ncluster-0 0 1\ncluster-1 1 7\n",
                           "enfilade-graph 1 2 1\ncluster-0 0\ncluster-1 1\n", "something else"}) {
    replace_file(path, text);
    EXPECT_THROW(read_graph(path), RunError) << text;
  }
}

}  // namespace
}  // namespace enfilade
