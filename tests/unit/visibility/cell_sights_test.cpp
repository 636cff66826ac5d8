#include "visibility/cell_sights.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/visibility/random_segments.hpp"

namespace enfilade {
namespace {

using testing::enfilade_of_rooms;
using testing::expect_no_pair_missed;
using testing::prepare;
using testing::Prepared;

bool contains(const std::vector<CellId>& cells, CellId cell) {
  return std::binary_search(cells.begin(), cells.end(), cell);
}

/// A line that leaves one cell and enters the other may be followed from either.
void expect_sees_what_portals_allow(const plan::Plan& plan) {
  const Prepared p = prepare(plan);
  const CellSights sights(p.complex, p.clusters);
  for (const auto& [a, b] : visible_cells(p.complex)) {
    EXPECT_TRUE(contains(sights.seen_from(a), b)) << a.value << " sees " << b.value;
    EXPECT_TRUE(contains(sights.seen_from(b), a)) << b.value << " sees " << a.value;
  }
}

/// Low and narrow doors in line: only from an end wall does a line pass several of them.
plan::Plan long_row() {
  plan::Plan plan;
  plan.box({0, 0, 0}, {20, 4, 2.5}, true);
  for (int i = 1; i < 5; ++i) plan.wall_with_door(4 * i, 0, 4, 2.5, 1.85, 2.15, 0.3);
  return plan;
}

/// The graph of clusters by the cells' sights alone: an edge where both see the other.
ClusterGraph graph_of(const CellSights& sights, std::size_t clusters) {
  const auto sees = [&](ClusterId a, ClusterId b) {
    const std::vector<CellId> seen = sights.seen_by(a);
    const std::span<const CellId> lies_in = sights.cells_of(b);
    return std::any_of(lies_in.begin(), lies_in.end(),
                       [&](CellId cell) { return contains(seen, cell); });
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < clusters; ++i) {
    for (std::uint32_t j = i + 1; j < clusters; ++j) {
      if (sees(ClusterId(i), ClusterId(j)) && sees(ClusterId(j), ClusterId(i)))
        pairs.emplace_back(i, j);
    }
  }
  return {clusters, std::move(pairs)};
}

TEST(CellSights, SeeWhatVisibleCellsSees) {
  plan::Plan far_away = enfilade_of_rooms();
  far_away.transform(plan::turn_and_move(1e5));
  for (const plan::Plan& plan : {plan::one_room(), plan::two_rooms(), plan::two_storeys(),
                                 enfilade_of_rooms(), long_row(), far_away}) {
    expect_sees_what_portals_allow(plan);
  }
}

TEST(CellSights, EitherEndOfALongRowSeesTheOther) {
  const Prepared p = prepare(long_row());
  const CellSights sights(p.complex, p.clusters);
  const CellId first = p.complex.locate({0.5, 0.5, 2}), last = p.complex.locate({19.5, 0.5, 2});
  ASSERT_TRUE(first.valid() && last.valid() && first != last);
  EXPECT_TRUE(contains(sights.seen_from(first), last));
  EXPECT_TRUE(contains(sights.seen_from(last), first));
}

TEST(CellSights, NoClusterThatASegmentReachesIsMissed) {
  plan::Plan far_away = enfilade_of_rooms();
  far_away.transform(plan::turn_and_move(1e5));
  for (const plan::Plan& plan : {plan::two_rooms(), plan::two_storeys(), far_away}) {
    Prepared p = prepare(plan);
    p.graph = graph_of(CellSights(p.complex, p.clusters), p.clusters.size());
    EXPECT_GT(expect_no_pair_missed(p, 50000), 15u);
  }
}

TEST(CellSights, DoorsOutOfLineHideTheLastRoom) {
  const Prepared p = prepare(enfilade_of_rooms());
  const CellSights sights(p.complex, p.clusters);
  const CellId first = p.complex.locate({0.5, 0.5, 2}), last = p.complex.locate({19.5, 0.5, 2});
  const CellId next = p.complex.locate({4.5, 0.5, 2});
  ASSERT_TRUE(first.valid() && last.valid() && next.valid());
  EXPECT_TRUE(contains(sights.seen_from(first), first));
  EXPECT_TRUE(contains(sights.seen_from(first), next));
  EXPECT_FALSE(contains(sights.seen_from(first), last));
  EXPECT_FALSE(contains(sights.seen_from(last), first));
}

TEST(CellSights, WhereTheSearchGivesUpAllConnectedCellsAreSeen) {
  const Prepared p = prepare(enfilade_of_rooms());
  const CellSights sights(p.complex, p.clusters, {.most_doorways = 1});
  const std::vector<CellId> seen = sights.seen_from(p.complex.locate({0.5, 0.5, 2}));
  EXPECT_EQ(seen.size(), 5u);
  for (int room = 0; room < 5; ++room)
    EXPECT_TRUE(contains(seen, p.complex.locate({4.0 * room + 0.5, 0.5, 2}))) << room;
}

TEST(CellSights, AClusterSeesWhatAnyOfItsCellsSees) {
  const Prepared p = prepare(enfilade_of_rooms());
  const CellSights sights(p.complex, p.clusters);
  for (const Cluster& cluster : p.clusters) {
    ASSERT_FALSE(sights.cells_of(cluster.id).empty());
    EXPECT_EQ(sights.cells_of(cluster.id).front(), cluster.cell);
    const std::vector<CellId> seen = sights.seen_by(cluster.id);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
    for (const CellId own : sights.cells_of(cluster.id)) {
      EXPECT_TRUE(contains(seen, own));
      for (const CellId cell : sights.seen_from(own)) EXPECT_TRUE(contains(seen, cell));
    }
  }
}

TEST(CellSights, AClusterThatSticksOutIsInBothCells) {
  Prepared p = prepare(enfilade_of_rooms());
  const CellId here = p.complex.locate({0.5, 0.5, 2}), there = p.complex.locate({19.5, 0.5, 2});
  ASSERT_NE(here, there);
  Cluster sticks_out;  // into a room that its own does not see
  sticks_out.id = ClusterId(p.clusters.size());
  sticks_out.cell = here;
  sticks_out.polygons.push_back(
      {SurfaceId(0u), {{18, 0.5, 2}, {19, 0.5, 2}, {19, 1, 2}, {18, 1, 2}}});
  sticks_out.bounds = bounds(sticks_out.polygons[0].polygon);
  p.clusters.push_back(sticks_out);
  const CellSights sights(p.complex, p.clusters);
  const std::span<const CellId> lies_in = sights.cells_of(sticks_out.id);
  ASSERT_EQ(lies_in.size(), 2u);
  EXPECT_EQ(lies_in[0], here);
  EXPECT_EQ(lies_in[1], there);
  ASSERT_EQ(sights.sticking_out().size(), 1u);
  EXPECT_EQ(sights.sticking_out()[0], sticks_out.id);
  EXPECT_FALSE(contains(sights.seen_from(here), there));
  EXPECT_TRUE(contains(sights.seen_by(sticks_out.id), there));
  EXPECT_TRUE(contains(sights.seen_by(sticks_out.id), here));
}

}  // namespace
}  // namespace enfilade
