#include "geometry/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.hpp"

namespace enfilade {
namespace {

std::vector<Box> random_boxes(std::size_t count, Random& random) {
  const auto within = [&](double size) {
    return size * Vec3(random.uniform(), random.uniform(), random.uniform());
  };
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    box.add(within(10.0));
    box.add(box.lo + within(2.0));
  }
  return boxes;
}

TEST(BoxTree, FindsWhatTryingAllFinds) {
  Random random(7);
  const std::vector<Box> boxes = random_boxes(400, random);
  const BoxTree tree(boxes);
  for (const double margin_m : {0.0, 0.3}) {
    std::size_t hits = 0;
    for (const Box& box : random_boxes(50, random)) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        if (boxes[i].overlaps(box, margin_m)) expected.push_back(i);
      }
      EXPECT_EQ(tree.touching(box, margin_m), expected);
      hits += expected.size();
    }
    EXPECT_GT(hits, 50u);
  }
}

TEST(BoxTree, TheNearestAreThoseOfTryingAll) {
  Random random(9);
  for (const std::size_t count : {20u, 400u}) {
    const std::vector<Box> boxes = random_boxes(count, random);
    const BoxTree tree(boxes);
    for (int trial = 0; trial < 50; ++trial) {
      const Vec3 p = 12.0 * Vec3(random.uniform(), random.uniform(), random.uniform());
      std::vector<std::pair<double, std::uint32_t>> all;
      for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 outside = glm::max(glm::max(boxes[i].lo - p, p - boxes[i].hi), Vec3(0.0));
        all.emplace_back(glm::length(outside), i);
      }
      std::sort(all.begin(), all.end());
      const std::vector<std::uint32_t> found = tree.nearest(p, 16);
      ASSERT_EQ(found.size(), 16u);
      // Of many as near as the last (0, for boxes around the point) any will do.
      for (std::size_t i = 0; i < 16; ++i) {
        const double distance = std::find_if(all.begin(), all.end(), [&](const auto& entry) {
                                  return entry.second == found[i];
                                })->first;
        EXPECT_NEAR(distance, all[i].first, 1e-12);
      }
    }
  }
}

TEST(BoxTree, BoxesThatOnlyTouchCount) {
  const BoxTree tree(std::vector<Box>{{Vec3(0), Vec3(1)}, {Vec3(1, 0, 0), Vec3(2, 1, 0)}});
  EXPECT_EQ(tree.touching({Vec3(1, 0, 0), Vec3(1, 1, 0)}, 0.0), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(tree.touching({Vec3(2.5, 0, 0), Vec3(3, 1, 0)}, 0.0), std::vector<std::uint32_t>{});
  EXPECT_EQ(tree.touching({Vec3(2.5, 0, 0), Vec3(3, 1, 0)}, 0.6), std::vector<std::uint32_t>{1});
}

TEST(BoxTree, NothingIsFoundAmongNone) {
  EXPECT_TRUE(BoxTree(std::span<const Box>{}).touching({Vec3(0), Vec3(1)}, 1.0).empty());
}

}  // namespace
}  // namespace enfilade
