#include "report/plans/floor_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "unit/report/lit_rooms.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Clusters of two rooms: room 0, lamp 0, room 1, lamp 1, shell.
const std::vector<Rank> owner{Rank{1}, Rank{0}, Rank{2}, Rank{2}, Rank{3}};

std::string svg_of(const test::LitRooms& rooms, const PlanSubject& subject) {
  return to_svg(floor_plans(rooms.solved().building(), subject).at(0).drawing);
}

TEST(FloorPlan, SaysItsStoreyAndItsHeight) {
  const test::LitRooms rooms(2);
  const PlannedBuilding building = rooms.solved().building();
  const auto plans = floor_plans(building, cells_subject(building));
  ASSERT_EQ(plans.size(), 1u);
  EXPECT_EQ(plans[0].title, "Storey 1: floor at 0.00 m, cut at 1.20 m");
  EXPECT_EQ(plans[0].subject, "cells");
}

TEST(FloorPlan, CellsHaveColoursAndNumbers) {
  const test::LitRooms rooms(2);
  const PlannedBuilding building = rooms.solved().building();
  const PlanSubject subject = cells_subject(building);
  EXPECT_NE(subject.cells[0], subject.cells[1]);
  const std::string svg = svg_of(rooms, subject);
  for (int cell = 0; cell < 2; ++cell) {
    EXPECT_THAT(svg, HasSubstr("class=\"cell\" fill=\"" + css(subject.cells[cell])));
    EXPECT_THAT(svg, HasSubstr(">" + std::to_string(cell) + "</text>"));
  }
  EXPECT_THAT(svg, HasSubstr("4.1 ")) << "the cut between the cells, in metres";
}

TEST(FloorPlan, WallsAreDrawn) {
  const test::LitRooms rooms(1);
  const std::string svg = svg_of(rooms, cells_subject(rooms.solved().building()));
  std::size_t lines = 0, at = 0;
  while ((at = svg.find("class=\"surface\"", at)) != std::string::npos) {
    const std::string path = svg.substr(at, svg.find("</path>", at) - at);
    lines += static_cast<std::size_t>(std::count(path.begin(), path.end(), 'M'));
    ++at;
  }
  EXPECT_EQ(lines, 8u) << "four walls and the four of the shell";
}

TEST(FloorPlan, AssignedClustersHaveTheColourOfTheirRank) {
  const test::LitRooms rooms(2);
  const PlanSubject subject = assignment_subject(rooms.solved().building(), owner);
  EXPECT_EQ(subject.cells[0], tint(rank_rgb(1), 0.35)) << "the rank with most of it";
  EXPECT_EQ(subject.cells[1], tint(rank_rgb(2), 0.35));
  EXPECT_EQ(subject.clusters[1].line, rank_rgb(0)) << "the lamp of room 0";
  const std::string svg = svg_of(rooms, subject);
  EXPECT_THAT(svg, HasSubstr("rank 1: 1 clusters"));
  EXPECT_THAT(svg, HasSubstr("stroke=\"" + rank_colour(1)));
  EXPECT_THAT(svg, HasSubstr("stroke=\"" + rank_colour(3)));
}

TEST(FloorPlan, TheVisibleSetStandsOut) {
  const test::LitRooms rooms(2);
  const PlannedBuilding building = rooms.solved().building();
  const ClusterGraph joined(5, {{0, 1}, {2, 3}, {0, 2}});
  const VisibleSet both = visible_set(building.cells, building.clusters, joined, CellId(1));
  EXPECT_THAT(both.cells, testing::ElementsAre(1, 1)) << "by the clusters 0 and 2";
  EXPECT_THAT(both.clusters, testing::ElementsAre(1, 0, 1, 1, 0));
  const ClusterGraph parted(5, {{0, 1}, {2, 3}});
  const VisibleSet set = visible_set(building.cells, building.clusters, parted, CellId(1));
  EXPECT_THAT(set.cells, testing::ElementsAre(0, 1));
  const PlanSubject subject = visible_subject(building, set);
  EXPECT_EQ(subject.cells[1], plan_ink::chosen);
  EXPECT_EQ(subject.cells[0], plan_ink::unseen);
  EXPECT_EQ(subject.clusters[4].line, plan_ink::faint);
  EXPECT_EQ(subject.clusters[2].line, plan_ink::black);
  EXPECT_THAT(subject.subtitle, HasSubstr("1 of 2 cells and 2 of 5 clusters"));
}

TEST(FloorPlan, FurnitureInTheMiddleOfARoomDoesNotHideItsFloor) {
  test::LitRooms rooms(1);
  Cluster table = rooms.clusters[0];
  table.id = ClusterId(rooms.clusters.size());
  table.polygons.clear();
  for (const Polygon& face : test::box_faces({1.5, 2, 0.5}, {2.5, 3, 0.8}, false))
    table.polygons.push_back({SurfaceId(0), face});
  rooms.clusters.push_back(table);
  const Occluders occluders(rooms.clusters);
  const auto found = storeys({rooms.cells, rooms.clusters, occluders});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].floor_m, 0.0, 1e-9);
  EXPECT_NEAR(found[0].headroom_m, 3.0, 0.11);
}

TEST(FloorPlan, RanksHaveColoursOfTheirOwn) {
  std::set<std::string> colours;
  for (int r = 0; r < 64; ++r) colours.insert(rank_colour(r));
  EXPECT_EQ(colours.size(), 64u);
}

}  // namespace
}  // namespace enfilade
