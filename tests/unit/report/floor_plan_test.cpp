#include "report/floor_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "lit_rooms.hpp"

namespace enfilade {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Clusters of two rooms: room 0, lamp 0, room 1, lamp 1, shell.
const std::vector<Rank> owner{Rank{1}, Rank{0}, Rank{2}, Rank{2}, Rank{3}};

TEST(FloorPlan, CellsHaveTheColourOfTheRankWithMostOfThem) {
  const test::LitRooms rooms(2);
  const auto plans = floor_plans(rooms.solved(), owner);
  ASSERT_EQ(plans.size(), 1u);
  EXPECT_EQ(plans[0].title, "storey 1, cut at 1.20 m");
  EXPECT_THAT(plans[0].svg, HasSubstr("class=\"cell\" fill=\"" + rank_colour(1)));
  EXPECT_THAT(plans[0].svg, HasSubstr("class=\"cell\" fill=\"" + rank_colour(2)));
  EXPECT_THAT(plans[0].svg, Not(HasSubstr("class=\"cell\" fill=\"" + rank_colour(0))));
  EXPECT_THAT(plans[0].svg, HasSubstr("cluster 1, rank 0"))
      << "the lamp of room 0 has a dot of its own";
}

TEST(FloorPlan, CellsAreCutWhereTheirPlaneIs) {
  const test::LitRooms rooms(2);
  const std::string svg = floor_plans(rooms.solved(), owner)[0].svg;
  // The plan's origin is at the rooms' corner (0, 0); the cut between the cells at x = 4.1 m.
  EXPECT_THAT(svg, HasSubstr("4.10 "));
}

TEST(FloorPlan, WallsAreDrawn) {
  const test::LitRooms rooms(1);
  const std::string svg = floor_plans(rooms.solved(), {})[0].svg;
  const std::size_t start = svg.find("class=\"wall\" d=\"");
  ASSERT_NE(start, std::string::npos);
  const std::string path = svg.substr(start, svg.find("/>", start) - start);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 8) << "four walls and the four of the shell";
}

TEST(FloorPlan, WithoutOwnersCellsAreShownByKind) {
  const test::LitRooms rooms(1);
  EXPECT_THAT(floor_plans(rooms.solved(), {})[0].svg, HasSubstr("fill=\"var(--room)\""));
}

TEST(FloorPlan, RanksHaveColoursOfTheirOwn) {
  std::set<std::string> colours;
  for (int r = 0; r < 64; ++r) colours.insert(rank_colour(r));
  EXPECT_EQ(colours.size(), 64u);
}

}  // namespace
}  // namespace enfilade
