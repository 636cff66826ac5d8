#include "app/enfilade_mpi.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace enfilade {
namespace {

bool needs(std::vector<const char*> words) {
  words.insert(words.begin(), "enfilade");
  return needs_mpi(static_cast<int>(words.size()), words.data());
}

TEST(EnfiladeMpi, IsNeededForSolveAlone) {
  EXPECT_TRUE(needs({"solve", "scene.json", "-o", "run"}));
  EXPECT_TRUE(needs({"--help", "solve"}));
  EXPECT_FALSE(needs({"info", "solve"}));
  EXPECT_FALSE(needs({"--help"}));
  EXPECT_FALSE(needs({}));
}

TEST(EnfiladeMpi, IsNeededByEveryRankOfALauncher) {
  ASSERT_EQ(setenv("OMPI_COMM_WORLD_SIZE", "2", 1), 0);
  EXPECT_TRUE(needs({"info", "scene.json"}));
  ASSERT_EQ(unsetenv("OMPI_COMM_WORLD_SIZE"), 0);
  EXPECT_FALSE(needs({"info", "scene.json"}));
}

}  // namespace
}  // namespace enfilade
