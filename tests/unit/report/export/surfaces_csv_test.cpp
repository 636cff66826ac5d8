#include "report/export/surfaces_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

std::vector<std::string> lines_of(const std::string& csv) {
  std::vector<std::string> lines;
  std::istringstream in(csv);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(SurfacesCsv, HasOneLineASurfaceAndNamesTheUnit) {
  test::LitRooms rooms(1, 2);
  const auto lines = lines_of(surfaces_csv(rooms.solved()));
  ASSERT_EQ(lines.size(), 1 + rooms.scene.surfaces.size());
  EXPECT_EQ(lines[0],
            "surface,name,object,area_m2,mean_irradiance_0 [lx],mean_irradiance_1 [lx],"
            "mean_radiosity_0 [lm/m2],mean_radiosity_1 [lm/m2]");
}

TEST(SurfacesCsv, MeansAreByArea) {
  test::LitRooms rooms;
  rooms.subdivide(0.3);
  rooms.set_irradiance([](const Vec3& p) { return 10.0 * p.x; });
  const auto lines = lines_of(surfaces_csv(rooms.solved()));
  // The floor, 4 m by 5 m: mean of 10 x over 0..4 is 20, of which half is reflected.
  EXPECT_EQ(lines[1], "0,\"room 0, face \"\"0\"\"\",room 0,20,20,10");
  // The lamp gives its exitance and reflects nothing.
  EXPECT_THAT(lines[7], testing::EndsWith(",lamp 0,1,20,100"));
}

TEST(SurfacesCsv, ADroppedSurfaceHasNoMeans) {
  test::LitRooms rooms;
  Surface dropped = rooms.scene.surfaces[0];
  dropped.name = "gone";
  rooms.scene.surfaces.push_back(dropped);
  EXPECT_EQ(lines_of(surfaces_csv(rooms.solved())).back(),
            std::to_string(rooms.scene.surfaces.size() - 1) + ",gone,room 0,0,,");
}

}  // namespace
}  // namespace enfilade
