#include "geometry/convex_merge.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(MergeConvex, TwoTrianglesBecomeASquare) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto merged = merge_convex(points, {{0, 1, 2}, {0, 2, 3}}, 1e-9, 1e-12);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged[0].size(), 4u);
}

TEST(MergeConvex, AnLShapeStaysInTwoPartsAndAFoldIsNotFlattened) {
  const std::vector<Vec3> shape{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const auto merged =
      merge_convex(shape, {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}, 1e-9, 1e-12);
  EXPECT_EQ(merged.size(), 2u);
  const std::vector<Vec3> folded{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.3}};
  EXPECT_EQ(merge_convex(folded, {{0, 1, 2}, {0, 2, 3}}, 1e-3, 1e-12).size(), 2u);
  // However large the scene that the tolerance comes from, a bend of a polygon's own size stays.
  EXPECT_EQ(merge_convex(folded, {{0, 1, 2}, {0, 2, 3}}, 100.0, 1e-12).size(), 2u);
}

}  // namespace
}  // namespace enfilade
