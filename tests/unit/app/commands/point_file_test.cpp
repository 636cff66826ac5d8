#include "app/commands/point_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace enfilade {
namespace {

std::string file_with(const std::string& text) {
  const std::string path = testing::TempDir() + "points.json";
  write_file_atomically(path, text);
  return path;
}

TEST(PointFile, AllThreeFormsGiveTheSamePoints) {
  const std::vector<Vec3> expected = {{1, 2, 3}, {-4, 5.5, 6}};
  for (const char* text : {R"({"points": [[1,2,3], [-4,5.5,6]]})", "[[1,2,3], [-4,5.5,6]]",
                           R"({"probes": [{"p": [1,2,3], "n": [0,0,1]}, {"p": [-4,5.5,6]}]})"}) {
    EXPECT_EQ(read_points(file_with(text)), expected) << text;
  }
}

TEST(PointFile, UnitsAreConverted) {
  EXPECT_EQ(read_points(file_with(R"({"units": "mm", "points": [[1000,0,-500]]})")),
            (std::vector<Vec3>{{1, 0, -0.5}}));
}

TEST(PointFile, AFaultNamesItsPlace) {
  try {
    read_points(file_with(R"({"points": [[1,2,3], [1,2]]})"));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.where(), testing::HasSubstr("points[1]"));
  }
  EXPECT_THROW(read_points(file_with(R"({"places": []})")), InputError);
}

}  // namespace
}  // namespace enfilade
