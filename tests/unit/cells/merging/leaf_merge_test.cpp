#include "cells/merging/leaf_merge.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

/// A wall between two leaves in a plane of its own; the leaf in front sees fronts, the one behind
/// sees what is said.
LeafInterface wall(std::uint32_t front_leaf, std::uint32_t back_leaf, std::uint32_t plane,
                   double area_m2, double open_m2, bool two_sided) {
  LeafInterface face;
  face.front_leaf = front_leaf;
  face.back_leaf = back_leaf;
  face.plane = face.cut = plane;
  face.n = Vec3(1, 0, 0);
  face.area_m2 = area_m2;
  face.open_m2 = open_m2;
  face.faces_front_m2 = area_m2 - open_m2;
  face.faces_back_m2 = two_sided ? area_m2 - open_m2 : 0.0;
  return face;
}

TEST(LeafMerge, WallsThatLeakIntoARoomTakeNoOtherRoomAlong) {
  // Rooms 0 and 1 share a door, the walls of the building (2, and 4 that shows nothing) leak into
  // room 0, all around is 3.
  const double volumes[] = {50.0, 50.0, 500.0, 5000.0, 1.0};
  const char touches_outside[] = {0, 0, 0, 1, 0};
  std::vector<LeafInterface> faces{wall(0, 2, 0, 60.0, 0.01, false),
                                   wall(1, 2, 1, 60.0, 0.0, false), wall(0, 1, 2, 8.0, 1.8, true),
                                   wall(3, 2, 3, 200.0, 0.0, false),
                                   wall(2, 4, 4, 1.0, 1.0, false)};
  faces[2].framed_m2 = faces[2].open_m2;
  const LeafGroups groups = merge_leaves(volumes, touches_outside, faces, MergeConfig{});
  EXPECT_EQ(groups.group_of_leaf[2], groups.group_of_leaf[0]);
  EXPECT_NE(groups.group_of_leaf[1], groups.group_of_leaf[0]);
  EXPECT_NE(groups.group_of_leaf[3], groups.group_of_leaf[0]);
  EXPECT_EQ(groups.kinds[groups.group_of_leaf[0]], CellKind::room);
  EXPECT_EQ(groups.kinds[groups.group_of_leaf[1]], CellKind::room);
  EXPECT_EQ(groups.kinds[groups.group_of_leaf[3]], CellKind::outside);
}

TEST(LeafMerge, ACavityIsNotBetweenARoomAndANook) {
  // The room 0 and the nook 1 are open to a cavity 2 in the walls, which is half open to 3.
  const double volumes[] = {50.0, 0.3, 5.0, 200.0, 5000.0};
  const char touches_outside[] = {0, 0, 0, 0, 1};
  const std::vector<LeafInterface> faces{
      wall(0, 2, 0, 0.6, 0.5, true), wall(1, 2, 1, 0.5, 0.5, true), wall(2, 3, 2, 60.0, 25.0, true),
      wall(0, 4, 3, 80.0, 0.0, true), wall(3, 4, 4, 80.0, 0.0, true)};
  const LeafGroups groups = merge_leaves(volumes, touches_outside, faces, MergeConfig{});
  EXPECT_NE(groups.group_of_leaf[0], groups.group_of_leaf[1]);
  EXPECT_NE(groups.group_of_leaf[0], groups.group_of_leaf[2]);
}

TEST(LeafMerge, ACavityIsNoConnectorOfWhatItHardlyOpensTo) {
  // The cavity 1 is wide open to the solid 2 alone; it leaks into the room 0, and to the outside 3.
  const double volumes[] = {50.0, 57.0, 60.0, 5000.0};
  const char touches_outside[] = {0, 0, 0, 1};
  const std::vector<LeafInterface> faces{
      wall(0, 1, 0, 20.0, 1.5, true), wall(1, 2, 1, 50.0, 49.0, true),
      wall(1, 3, 2, 10.0, 1.0, true), wall(0, 3, 3, 80.0, 0.0, true),
      wall(3, 2, 4, 80.0, 0.0, false)};
  const LeafGroups groups = merge_leaves(volumes, touches_outside, faces, MergeConfig{});
  EXPECT_NE(groups.group_of_leaf[0], groups.group_of_leaf[1]);
  EXPECT_NE(groups.group_of_leaf[0], groups.group_of_leaf[3]);
  EXPECT_NE(groups.group_of_leaf[1], groups.group_of_leaf[3]);
}

}  // namespace
}  // namespace enfilade
