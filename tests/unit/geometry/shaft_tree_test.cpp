#include "geometry/shaft_tree.hpp"

#include <gtest/gtest.h>

#include "base/random.hpp"

namespace enfilade {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;

Polygon upright(double x, double size, double y = 0.0, double z = 0.0) {
  return {{x, y, z}, {x, y + size, z}, {x, y + size, z + size}, {x, y, z + size}};
}

Polygon reversed(const Polygon& p) { return {p.rbegin(), p.rend()}; }

TEST(ShaftTree, FindsAPolygonBetweenTwoAndNoneBesideOrBehindThem) {
  const Polygon a = upright(0.0, 1.0), b = reversed(upright(2.0, 1.0));
  const ShaftTree tree(
      {a, b, upright(1.0, 0.1, 0.4, 0.4), upright(1.0, 0.1, 1.5), upright(3.0, 1.0)});
  const Shaft shaft = shaft_between(a, b, 1e-6);
  EXPECT_TRUE(tree.blocked(shaft, 1e-6, 0, 1));
  EXPECT_FALSE(tree.blocked(shaft, 1e-6, 2, none));
  std::vector<std::uint32_t> found;
  tree.find(shaft, 1e-6, 0, 1, 10, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{2}));
}

TEST(ShaftTree, FindAmongAllGivesThePolygonsThatFindGives) {
  Random random(9);
  std::vector<Polygon> polygons;
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < 60; ++i) {
    polygons.push_back(upright(2.0 * random.uniform(), 0.1 + 0.3 * random.uniform(),
                               2.0 * random.uniform() - 0.5, 2.0 * random.uniform() - 0.5));
    all.push_back(i);
  }
  const ShaftTree tree(polygons);
  const Shaft shaft = shaft_between(upright(0.0, 1.0), reversed(upright(2.0, 1.0)), 1e-6);
  std::vector<std::uint32_t> found, among;
  tree.find(shaft, 1e-6, none, none, all.size(), found);
  tree.find_among(all, shaft, 1e-6, none, none, among);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, among);
  EXPECT_GT(found.size(), 5u);
  EXPECT_LT(found.size(), 60u);
}

TEST(ShaftTree, TouchingCountsAReachBeyondTheRim) {
  const ShaftTree tree({upright(0.0, 1.0), upright(1.0, 1.0)});
  EXPECT_EQ(tree.touching({0.05, 0.5, 0.5}, 0.1), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(tree.touching({1.0, 1.05, 0.5}, 0.1), (std::vector<std::uint32_t>{1}));
  EXPECT_TRUE(tree.touching({1.0, 1.15, 0.5}, 0.1).empty());
}

}  // namespace
}  // namespace enfilade
