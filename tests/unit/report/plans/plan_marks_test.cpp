#include "report/plans/plan_marks.hpp"

#include <gtest/gtest.h>

#include "cells/rooms/build_cells.hpp"
#include "report/plans/plan_outline.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"
#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

CellComplex build_marked(const plan::Plan& plan) { return build_cells(plan.pieces(), {}); }

TEST(PlanMarks, ADoorIsALineAcrossItsOpening) {
  const auto marks = portal_marks(build_marked(plan::two_rooms()), {{0.0, 2.5}, 1.2}, 0.1);
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].side, PortalSide::room);
  EXPECT_EQ(marks[0].view, PortalView::cut);
  ASSERT_EQ(marks[0].lines.size(), 1u);
  const Path& line = marks[0].lines[0];
  EXPECT_NEAR(glm::length(line[1] - line[0]), 0.9, 1e-6);
  for (const Vec2& p : line) EXPECT_NEAR(p.x, 4.0, 1e-6);
  EXPECT_NEAR(std::min(line[0].y, line[1].y), 1.0, 1e-6);
}

TEST(PlanMarks, ADoorBelowTheCutIsDashedAndOneOfAnotherStoreyIsLeftOut) {
  const CellComplex complex = build_marked(plan::two_rooms());
  const auto marks = portal_marks(complex, {{0.0, 2.5}, 2.2}, 0.1);
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_EQ(marks[0].view, PortalView::beyond);
  EXPECT_GT(marks[0].lines.size(), 2u);
  double drawn_m = 0.0;
  for (const Path& dash : marks[0].lines) drawn_m += glm::length(dash[1] - dash[0]);
  EXPECT_NEAR(drawn_m, 0.45, 1e-6) << "half of the door's width";
  EXPECT_TRUE(portal_marks(complex, {{5.0, 2.5}, 6.2}, 0.1).empty());
}

TEST(PlanMarks, AStairOpeningIsHatchedInBothStoreys) {
  const CellComplex complex = build_marked(plan::two_storeys());
  for (const PlanCut& cut : {PlanCut{{0.0, 2.5}, 1.2}, PlanCut{{2.8, 3.0}, 4.0}}) {
    Box box;
    std::size_t lines = 0;
    for (const PortalMark& mark : portal_marks(complex, cut, 0.1)) {
      if (mark.view != PortalView::level) continue;
      lines += mark.lines.size();
      for (const Path& line : mark.lines) {
        for (const Vec2& p : line) box.add(Vec3(p, 0.0));
      }
    }
    EXPECT_GT(lines, 20u);
    EXPECT_NEAR(box.lo.x, 0.0, 1e-6);
    EXPECT_NEAR(box.hi.x, 2.0, 1e-6);
    EXPECT_NEAR(box.hi.y, 3.0, 1e-6);
  }
}

Cluster cluster_of(std::vector<Polygon> polygons) {
  Cluster cluster;
  cluster.id = ClusterId(0);
  for (Polygon& polygon : polygons) {
    cluster.bounds.add(bounds(polygon));
    cluster.polygons.push_back({SurfaceId(0), std::move(polygon)});
  }
  return cluster;
}

TEST(PlanMarks, FurnitureBelowTheCutHasItsFootprint) {
  const std::vector<Cluster> table{cluster_of(test::box_faces({1, 1, 0}, {2, 3, 0.7}, false))};
  const auto marks = cluster_marks(table, {{0.0, 2.5}, 1.2});
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_TRUE(marks[0].below);
  ASSERT_EQ(marks[0].paths.size(), 1u);
  EXPECT_EQ(marks[0].paths[0].size(), 4u) << "top and bottom lie over each other";
}

TEST(PlanMarks, WhatTheCutMeetsIsLinesAndFloorsAndLampsAreNotThere) {
  const std::vector<Cluster> wardrobe{cluster_of(test::box_faces({1, 1, 0}, {2, 3, 2.0}, false))};
  const auto marks = cluster_marks(wardrobe, {{0.0, 2.5}, 1.2});
  ASSERT_EQ(marks.size(), 1u);
  EXPECT_FALSE(marks[0].below);
  EXPECT_EQ(marks[0].paths.size(), 4u);
  const std::vector<Cluster> flat{cluster_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}),
                                  cluster_of({{{0, 0, 2.4}, {1, 1, 2.4}, {1, 0, 2.4}}})};
  EXPECT_TRUE(cluster_marks(flat, {{0.0, 2.5}, 1.2}).empty());
}

double ring_area(const Path& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * std::abs(twice);
}

TEST(PlanOutline, TheLargestCircleOfAnLIsAtItsThickPlace) {
  const std::vector<Polygon> l{{{0, 0, 0}, {6, 0, 0}, {6, 1, 0}, {0, 1, 0}},
                               {{0, 1, 0}, {3, 1, 0}, {3, 4, 0}, {0, 4, 0}}};
  const InnerCircle circle = largest_circle(l);
  EXPECT_NEAR(circle.radius_m, 1.5, 0.05);
  EXPECT_NEAR(circle.centre.x, 1.5, 0.1);
  const auto rings = footprint(l);
  ASSERT_EQ(rings.size(), 1u) << "the parts have grown together";
  EXPECT_NEAR(ring_area(rings[0]), 15.0, 1e-9);
}

}  // namespace
}  // namespace enfilade
