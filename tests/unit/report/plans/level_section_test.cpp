#include "report/plans/level_section.hpp"

#include <gtest/gtest.h>

#include "cells/rooms/build_cells.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"
#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

CellComplex build(const plan::Plan& plan) { return build_cells(plan.pieces(), {}); }

Box ground(double x, double y) {
  Box box;
  box.add({0, 0, 0});
  box.add({x, y, 0});
  return box;
}

double area_of(const std::vector<CellSection>& sections, CellId cell) {
  for (const CellSection& section : sections) {
    if (section.cell == cell) return section.area_m2;
  }
  return 0.0;
}

TEST(LevelSection, TwoRoomsHaveTheirFloorAreas) {
  const CellComplex complex = build(plan::two_rooms());
  const auto sections = level_section(complex, ground(10, 4), 1.2);
  EXPECT_NEAR(area_of(sections, complex.locate({2, 2, 1})), 16.0, 1e-9);
  EXPECT_NEAR(area_of(sections, complex.locate({8, 2, 1})), 24.0, 1e-9);
}

TEST(LevelSection, ATurnedHouseKeepsItsAreas) {
  plan::Plan plan = plan::two_rooms();
  const double c = std::cos(0.5), s = std::sin(0.5);
  const auto turn = [=](const Vec3& p) {
    return Vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z) + Vec3(30.0, 20.0, 4.0);
  };
  plan.transform(turn);
  const CellComplex complex = build(plan);
  Box box;
  for (const Polygon& polygon : plan.polygons) box.add(bounds(polygon));
  const auto sections = level_section(complex, box, 5.2);
  EXPECT_NEAR(area_of(sections, complex.locate(turn({2, 2, 1}))), 16.0, 1e-6);
  EXPECT_NEAR(area_of(sections, complex.locate(turn({8, 2, 1}))), 24.0, 1e-6);
  double whole = 0.0;
  for (const CellSection& section : sections) whole += section.area_m2;
  EXPECT_NEAR(whole, box.extent().x * box.extent().y, 1e-6) << "parts are disjoint and all of it";
}

TEST(LevelSection, TheHeightDecidesWhichStoreyIsMet) {
  const CellComplex complex = build(plan::two_storeys());
  const CellId below = complex.locate({6, 1, 1}), above = complex.locate({6, 1, 4});
  ASSERT_NE(below, above);
  EXPECT_NEAR(area_of(level_section(complex, ground(8, 6), 1.2), below), 48.0, 1e-9);
  EXPECT_NEAR(area_of(level_section(complex, ground(8, 6), 4.0), above), 48.0, 1e-9);
  EXPECT_EQ(area_of(level_section(complex, ground(8, 6), 4.0), below), 0.0);
}

TEST(LevelSection, APolygonIsCutWhereItCrosses) {
  const Polygon leaning{{0, 0, 0}, {4, 0, 0}, {4, 2, 2}, {0, 2, 2}};
  const auto line = level_cut(leaning, 0.5);
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(glm::length(line->second - line->first), 4.0, 1e-12);
  EXPECT_NEAR(line->first.y, 0.5, 1e-12);
  EXPECT_FALSE(level_cut(leaning, 2.5).has_value());
}

}  // namespace
}  // namespace enfilade
