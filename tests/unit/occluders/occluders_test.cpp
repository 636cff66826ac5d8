#include "occluders/occluders.hpp"

#include <gtest/gtest.h>

#include "unit/gather/box_room.hpp"

namespace enfilade {
namespace {

TEST(Occluders, AnEmptyRoomIsProvenOpen) {
  const Scene scene = testing::box_room({0, 0, 0}, {4, 5, 3}, {0.5}, {0.0});
  const auto clusters = testing::clusters_of(scene);
  const Occluders occluders(clusters);
  for (std::uint32_t i = 0; i < 6; ++i) {
    for (std::uint32_t j = 0; j < 6; ++j) {
      if (i == j) continue;
      EXPECT_TRUE(
          occluders.shaft_open(scene.surfaces[i].vertices, scene.surfaces[j].vertices, i, j));
    }
  }
}

TEST(Occluders, ABlockInTheWayIsNotProvenOpen) {
  Scene scene = testing::box_room({0, 0, 0}, {4, 5, 3}, {0.5}, {0.0});
  testing::add_block(scene, {1.9, 2.4, 1.4}, {2.1, 2.6, 1.6}, {0.5}, {0.0});
  const Occluders occluders(testing::clusters_of(scene));
  EXPECT_FALSE(occluders.shaft_open(scene.surfaces[0].vertices, scene.surfaces[1].vertices, 0, 1));
}

TEST(Occluders, AWallBetweenIsProvenShutAndAWallWithAGapIsNot) {
  const Polygon left{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const Polygon right{{2, 0, 0}, {2, 0, 1}, {2, 1, 1}, {2, 1, 0}};
  for (const double top : {1.0, 0.9}) {
    Scene scene;
    for (const Polygon& p :
         {left, right, Polygon{{1, 0, 0}, {1, 1, 0}, {1, 1, top}, {1, 0, top}}}) {
      Surface s;
      s.vertices = p;
      s.reflectance = s.exitance = {0.0};
      scene.surfaces.push_back(s);
    }
    const Occluders occluders(testing::clusters_of(scene));
    EXPECT_EQ(occluders.shaft_shut(left, right, 2), top == 1.0);
  }
}

}  // namespace
}  // namespace enfilade
