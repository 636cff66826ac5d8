#include "geometry/visible_parts.hpp"

#include <gtest/gtest.h>

#include "geometry/form_factor.hpp"

namespace enfilade {
namespace {

/// Form factor from the unit square [0,1]^2, facing up, to `to` past the occluders: the mean over
/// a grid of points.
double factor_past(const Polygon& to, const std::vector<Polygon>& occluders) {
  constexpr int side = 160;
  double sum = 0.0;
  VisibleParts parts;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      parts.begin({(i + 0.5) / side, (j + 0.5) / side, 0.0}, to, 1e-9);
      for (const Polygon& occluder : occluders) EXPECT_TRUE(parts.hide(occluder));
      sum += parts.factor({0.0, 0.0, 1.0});
    }
  }
  return sum / (side * side);
}

// Exact to 1e-7, by adaptive Gauss quadrature over the receiver with clipped polygons, in another
// language and by other means than ours.
TEST(VisibleParts, FormFactorsPastOccludersAreTheKnownOnes) {
  const Polygon above{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const Polygon beside{{2, 0, 0}, {2, 0, 1}, {2, 1, 1}, {2, 1, 0}};
  EXPECT_NEAR(
      factor_past(above, {{{.25, .25, .5}, {.75, .25, .5}, {.75, .75, .5}, {.25, .75, .5}}}),
      0.09950629460, 1e-5);
  EXPECT_NEAR(factor_past(above, {{{.1, .3, .3}, {.6, .2, .4}, {.7, .8, .45}, {.2, .9, .35}}}),
              0.09265944819, 1e-5);
  EXPECT_NEAR(factor_past(above, {{{0, .4, .5}, {1, .4, .5}, {1, .45, .5}, {0, .45, .5}},
                                  {{.4, 0, .6}, {.45, 0, .6}, {.45, 1, .6}, {.4, 1, .6}}}),
              0.17056971631, 1e-5);
  EXPECT_NEAR(factor_past(beside, {{{1.5, 0, 0}, {1.5, 0, .4}, {1.5, 1, .4}, {1.5, 1, 0}},
                                   {{1.5, 0, .6}, {1.5, 0, 1}, {1.5, 1, 1}, {1.5, 1, .6}}}),
              0.01242042878, 1e-5);
}

TEST(VisibleParts, WhatLiesBeyondBesideOrEdgeOnHidesNothing) {
  const Polygon above{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  VisibleParts parts;
  parts.begin({0.5, 0.5, 0.0}, above, 1e-9);
  const Polygon beyond{{0, 0, 1.1}, {1, 0, 1.1}, {1, 1, 1.1}, {0, 1, 1.1}};
  const Polygon beside{{3, 0, .5}, {4, 0, .5}, {4, 1, .5}, {3, 1, .5}};
  const Polygon edge_on{{.5, 0, .2}, {.5, 1, .2}, {.5, 1, .8}, {.5, 0, .8}};
  for (const Polygon& polygon : {beyond, beside, edge_on}) EXPECT_TRUE(parts.hide(polygon));
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts.factor({0, 0, 1}), point_to_polygon({0.5, 0.5, 0.0}, {0, 0, 1}, above));
}

TEST(VisibleParts, AWallHidesAllAndTooManyPartsAreReported) {
  const Polygon above{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  VisibleParts parts;
  parts.begin({0.5, 0.5, 0.0}, above, 1e-9);
  EXPECT_FALSE(parts.hide(Polygon{{.4, .4, .5}, {.6, .4, .5}, {.6, .6, .5}, {.4, .6, .5}}, 3));
  EXPECT_TRUE(parts.hide(Polygon{{-1, -1, .5}, {2, -1, .5}, {2, 2, .5}, {-1, 2, .5}}));
  EXPECT_TRUE(parts.empty());
}

}  // namespace
}  // namespace enfilade
