#include "cells/partition/apertures.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

const Vec3 ex(1, 0, 0), ey(0, 1, 0), ez(0, 0, 1);

/// A room of 8 x 4 x 2.5 m with a wall in the plane x = 4, and a door in it from y = 1 to y = 2, as
/// high as the room. The planes of another wall, y = 1.45 and y = 1.55, cut the room first, so that
/// the slab between them lies across the door.
class Doorway {
 public:
  explicit Doorway(double wall_bottom_m = 0.0, double wall_top_m = 2.5) {
    planes_.planes = {{ey, 1.45}, {ey, 1.55}, {ex, 4.0}, {ez, 0.0}};
    const Vec3 lo(0, 0, -1), hi(8, 4, 2.5);
    const std::vector<Vec3> corners{lo, hi};
    tree_.nodes.resize(1);
    tree_.nodes[0].cell = CellId(0);
    tree_.leaves.push_back(box_region(corners, {ex, ey, ez}, 0.0));
    cut(0, 3);  // the floor: leaf 0 is below it
    tree_.cuts.back().covered_by.push_back(rectangle({0, 0, 0}, 8.0 * ex, 4.0 * ey));
    cut(1, 0);
    cut(2, 1);
    for (const std::uint32_t leaf : {1u, 3u}) {
      cut(leaf, 2);
      const double y0 = leaf == 1 ? 0.0 : 2.0, y1 = leaf == 1 ? 1.0 : 4.0;
      tree_.cuts.back().covered_by.push_back(
          rectangle({4, y0, wall_bottom_m}, (y1 - y0) * ey, (wall_top_m - wall_bottom_m) * ez));
    }
    find();
  }

  std::vector<LeafAcross> frame(const Vec3& up = ez) {
    return frame_apertures(interfaces_, tree_, planes_, {up, 1e-3, 0.45});
  }
  void cut(std::uint32_t leaf, std::uint32_t plane) {
    const LeafAcross one[] = {{leaf, plane}};
    cut_leaves(tree_, one, {}, planes_, 1e-3);
  }
  void find() { interfaces_ = find_interfaces(tree_, 1e-5); }
  /// The open area in the wall's plane, and what is framed of it, m2.
  std::pair<double, double> open_and_framed() const {
    std::pair<double, double> sum{0.0, 0.0};
    for (const LeafInterface& face : interfaces_) {
      if (face.plane != 2) continue;
      sum.first += face.open_m2;
      sum.second += face.framed_m2;
    }
    return sum;
  }

 private:
  static InPlane rectangle(const Vec3& corner, const Vec3& u, const Vec3& v) {
    Polygon polygon{corner, corner + u, corner + u + v, corner + v};
    const Box box = bounds(polygon);
    return {std::move(polygon), box, true};
  }

  PlaneSet planes_;
  BspTree tree_;
  std::vector<LeafInterface> interfaces_;
};

TEST(Apertures, ALeafAcrossADoorIsFoundAndTheWholeDoorIsFramed) {
  Doorway doorway;
  const auto across = doorway.frame();
  ASSERT_EQ(across.size(), 1u);
  EXPECT_EQ(across[0].leaf, 2u);  // the slab
  EXPECT_EQ(across[0].plane, 2u);
  doorway.cut(across[0].leaf, across[0].plane);
  doorway.find();
  EXPECT_TRUE(doorway.frame().empty());
  const auto [open, framed] = doorway.open_and_framed();
  EXPECT_NEAR(open, 1.0 * 2.5, 1e-9);
  EXPECT_NEAR(framed / open, 2.0 * 2.5 / (2.0 * 2.5 + 2.0 * 1.0), 1e-9);  // two jambs, no lintel
}

TEST(Apertures, ALevelPlaneHasNoDoors) { EXPECT_TRUE(Doorway().frame(ex).empty()); }

TEST(Apertures, AJointBelowTheFloorFramesNothing) {
  Doorway joint(-1.0, 0.0);
  EXPECT_TRUE(joint.frame().empty());
  EXPECT_EQ(joint.open_and_framed().second, 0.0);
}

}  // namespace
}  // namespace enfilade
