// No visible pair may be missing: random segments between front sides, tested against every polygon
// in double precision, must all join clusters that G_cluster joins.
#include "visibility/cluster_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/random.hpp"
#include "cells/rooms/build_cells.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"

namespace enfilade {
namespace {

struct Prepared {
  CellComplex complex;
  std::vector<Cluster> clusters;
  ClusterGraph graph;
};

Prepared prepare(const plan::Plan& plan, const VisibilityConfig& config = {}) {
  Prepared p;
  p.complex = build_cells(plan.pieces(), {});
  std::vector<CellPiece> parts;
  for (const Piece& piece : plan.pieces()) {
    for (CellPiece& part : p.complex.cut(piece)) parts.push_back(std::move(part));
  }
  p.clusters = build_clusters(plan.scene(), parts, {});
  p.graph = visible_clusters(p.complex, p.clusters, {}, config);
  return p;
}

bool blocks(const Polygon& polygon, const Vec3& a, const Vec3& b) {
  const Plane plane = plane_of(polygon);
  const double da = plane.signed_distance(a), db = plane.signed_distance(b);
  if (da * db >= 0.0) return false;
  const Vec3 hit = a + da / (da - db) * (b - a);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (glm::dot(glm::cross(plane.n, edge), hit - polygon[i]) < 0.0) return false;
  }
  return true;
}

Vec3 random_point(const Polygon& polygon, Random& random) {
  double left = random.uniform() * area_m2(polygon);
  std::size_t k = 1;
  for (; k + 2 < polygon.size(); ++k) {
    left -= area_m2(Polygon{polygon[0], polygon[k], polygon[k + 1]});
    if (left <= 0.0) break;
  }
  const double s = std::sqrt(random.uniform()), t = random.uniform();
  return (1.0 - s) * polygon[0] + s * ((1.0 - t) * polygon[k] + t * polygon[k + 1]);
}

// Pairs of clusters that random unblocked segments join; every one of them must be an edge.
std::size_t expect_no_pair_missed(const Prepared& p, int segments) {
  struct Entry {
    Polygon polygon;
    Plane plane;
    std::uint32_t cluster;
  };
  std::vector<Entry> entries;
  for (const Cluster& cluster : p.clusters) {
    for (const ClusterPolygon& polygon : cluster.polygons) {
      entries.push_back({polygon.polygon, plane_of(polygon.polygon), cluster.id.value});
    }
  }
  Random random(5);
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (int i = 0; i < segments; ++i) {
    const Entry& from = entries[random.below(entries.size())];
    const Entry& to = entries[random.below(entries.size())];
    const Vec3 a = random_point(from.polygon, random), b = random_point(to.polygon, random);
    if (from.plane.signed_distance(b) <= 1e-9 || to.plane.signed_distance(a) <= 1e-9) continue;
    bool free = true;
    for (const Entry& other : entries) {
      if (&other != &from && &other != &to && blocks(other.polygon, a, b)) {
        free = false;
        break;
      }
    }
    if (!free || from.cluster == to.cluster) continue;
    found.emplace(std::min(from.cluster, to.cluster), std::max(from.cluster, to.cluster));
    EXPECT_TRUE(p.graph.has_edge(from.cluster, to.cluster))
        << from.cluster << " sees " << to.cluster;
  }
  return found.size();
}

plan::Plan enfilade_of_rooms() {
  plan::Plan plan;
  plan.box({0, 0, 0}, {20, 4, 2.5}, true);
  for (int i = 1; i < 5; ++i) {
    const double door = i % 2 == 0 ? 0.5 : 2.5;
    plan.wall_with_door(4 * i, 0, 4, 2.5, door, door + 0.9, 2);
  }
  for (int i = 0; i < 5; ++i) plan.box({4 * i + 1.0, 1.5, 0}, {4 * i + 1.5, 2.5, 0.7}, false);
  return plan;
}

TEST(ClusterGraph, RowsAreSortedAndSymmetric) {
  const ClusterGraph graph(4, {{2, 1}, {1, 2}, {0, 3}, {3, 1}, {2, 2}});
  EXPECT_EQ(graph.edges(), 3u);
  EXPECT_TRUE(graph.has_edge(1, 3) && graph.has_edge(3, 1) && !graph.has_edge(0, 1));
  const auto row = graph.neighbours(1);
  EXPECT_EQ(std::vector<std::uint32_t>(row.begin(), row.end()), (std::vector<std::uint32_t>{2, 3}));
}

TEST(VisibleClusters, WallsOfARoomSeeEachOther) {
  const Prepared p = prepare(plan::one_room());
  EXPECT_EQ(p.graph.edges(), 15u);
}

TEST(VisibleClusters, NoPairMissedThroughADoor) {
  const Prepared p = prepare(plan::two_rooms());
  EXPECT_GT(expect_no_pair_missed(p, 200000), 30u);
}

TEST(VisibleClusters, NoPairMissedThroughAStairHole) {
  EXPECT_GT(expect_no_pair_missed(prepare(plan::two_storeys()), 200000), 20u);
}

TEST(VisibleClusters, NoPairMissedInATurnedBuildingFarAway) {
  plan::Plan plan = enfilade_of_rooms();
  plan.transform(plan::turn_and_move(1e5));
  EXPECT_GT(expect_no_pair_missed(prepare(plan), 200000), 100u);
}

TEST(VisibleClusters, NoPairMissedWhenSequencesAreCutShort) {
  VisibilityConfig config;
  config.max_passes = 0;
  EXPECT_GT(expect_no_pair_missed(prepare(enfilade_of_rooms(), config), 200000), 100u);
}

TEST(VisibleClusters, NoPairMissedWherePairsAreProvedHidden) {
  plan::Plan plan = enfilade_of_rooms();
  plan.transform(plan::turn_and_move(1e3));
  VisibilityConfig config;
  config.prove_hidden = false;
  const Prepared loose = prepare(plan, config), tight = prepare(plan);
  const std::size_t found = expect_no_pair_missed(tight, 200000);
  EXPECT_LT(tight.graph.edges(), loose.graph.edges());
  EXPECT_LT(static_cast<double>(tight.graph.edges()), 1.5 * static_cast<double>(found));
}

TEST(VisibleClusters, RoomsThatNoLineJoinsDoNotSeeEachOther) {
  const Prepared p = prepare(enfilade_of_rooms());
  const CellId first = p.complex.locate({0.5, 0.5, 2}), last = p.complex.locate({19.5, 0.5, 2});
  ASSERT_NE(first, last);
  ASSERT_EQ(p.complex.portals().size(), 4u);
  for (const Cluster& a : p.clusters) {
    for (const Cluster& b : p.clusters) {
      if (a.cell == first && b.cell == last) {
        EXPECT_FALSE(p.graph.has_edge(a.id.index(), b.id.index()));
      }
    }
  }
  const std::size_t found = expect_no_pair_missed(p, 200000);
  EXPECT_LT(static_cast<double>(p.graph.edges()), 2.0 * static_cast<double>(found));
}

TEST(VisibleCells, FollowTheDoorsThatStandInLine) {
  plan::Plan plan;
  plan.box({0, 0, 0}, {12, 4, 2.5}, true);
  plan.wall_with_door(4, 0, 4, 2.5, 1, 1.9, 2);
  plan.wall_with_door(8, 0, 4, 2.5, 1, 1.9, 2);
  const CellComplex complex = build_cells(plan.pieces(), {});
  EXPECT_EQ(visible_cells(complex).size(), 6u);  // three cells with themselves, and all three pairs
}

}  // namespace
}  // namespace enfilade
