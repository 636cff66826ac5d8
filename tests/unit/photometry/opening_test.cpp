// Luminous openings by the signs of LM-63's sizes, and what they are made of.
#include <gtest/gtest.h>

#include "geometry/polygon.hpp"
#include "photometry/luminous_opening.hpp"

namespace enfilade {
namespace {

OpeningShape shape(int year, double w, double l, double h, bool expect_known = true) {
  bool known = false;
  const LuminousOpening opening = opening_by_lm63(year, w, l, h, known);
  EXPECT_EQ(known, expect_known);
  return opening.shape;
}

TEST(LuminousOpening, FollowsEachEditionOfTheStandard) {
  EXPECT_EQ(shape(2002, 0, 0, 0), OpeningShape::point);
  EXPECT_EQ(shape(1986, 0.6, 1.2, 0), OpeningShape::rectangle);
  EXPECT_EQ(shape(2002, 0.6, 1.2, 0.1), OpeningShape::box);
  EXPECT_EQ(shape(1991, -0.2, 0, 0), OpeningShape::disc);
  EXPECT_EQ(shape(2002, -0.2, -0.2, 0), OpeningShape::disc);
  EXPECT_EQ(shape(2019, -0.2, -0.4, 0.3), OpeningShape::cylinder);
  EXPECT_EQ(shape(1995, -0.2, 0, 0.3), OpeningShape::cylinder);
  EXPECT_EQ(shape(2002, -0.2, -0.2, -0.2), OpeningShape::ellipsoid);
  EXPECT_EQ(shape(1995, -0.2, 0, -0.2), OpeningShape::ellipsoid);
  EXPECT_EQ(shape(2002, -0.2, 0, -0.2), OpeningShape::upright_disc);
  EXPECT_EQ(shape(1995, 0, 1.2, -0.1), OpeningShape::cylinder_right);
  EXPECT_EQ(shape(2002, -0.1, 1.2, -0.1), OpeningShape::cylinder_right);
  EXPECT_EQ(shape(2002, 1.2, -0.1, -0.1), OpeningShape::cylinder_up);
  EXPECT_EQ(shape(2002, 0.5, -0.5, 0.2, false), OpeningShape::ellipsoid);
}

TEST(LuminousOpening, LengthLiesAlongTheHalfPlanes0And180) {
  bool known = false;
  const LuminousOpening opening = opening_by_lm63(2002, 0.3, 1.2, 0, known);
  EXPECT_EQ(opening.size, Vec3(1.2, 0.3, 0.0));
}

TEST(LuminousOpening, FacesHaveTheAreaOfTheShape) {
  const auto area = [](const LuminousOpening& opening) { return total_area_m2(opening.faces()); };
  EXPECT_TRUE(LuminousOpening{}.faces().empty());
  EXPECT_NEAR(area({OpeningShape::rectangle, {0.6, 0.3, 0}}), 0.18, 1e-12);
  EXPECT_NEAR(area({OpeningShape::disc, {0.6, 0.3, 0}}), 0.18 * 3.14159265358979 / 4.0, 1e-9);
  EXPECT_NEAR(area({OpeningShape::box, {1, 2, 3}}), 22.0, 1e-12);
  EXPECT_GT(area({OpeningShape::rectangle, {1.2, 0, 0}}), 0.0);  // a line
  EXPECT_EQ((LuminousOpening{OpeningShape::ellipsoid, {1, 1, 1}}.faces().size()), 6u);
}

}  // namespace
}  // namespace enfilade
