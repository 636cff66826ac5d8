// Buildings with their clusters, and random segments that show which clusters see each other.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/random.hpp"
#include "cells/rooms/build_cells.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"
#include "visibility/cluster_graph.hpp"

namespace enfilade::testing {

struct Prepared {
  CellComplex complex;
  std::vector<Cluster> clusters;
  ClusterGraph graph;
};

inline Prepared prepare(const plan::Plan& plan, const VisibilityConfig& config = {}) {
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

inline bool blocks(const Polygon& polygon, const Vec3& a, const Vec3& b) {
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

inline Vec3 random_point(const Polygon& polygon, Random& random) {
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
inline std::size_t expect_no_pair_missed(const Prepared& p, int segments) {
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

inline plan::Plan enfilade_of_rooms() {
  plan::Plan plan;
  plan.box({0, 0, 0}, {20, 4, 2.5}, true);
  for (int i = 1; i < 5; ++i) {
    const double door = i % 2 == 0 ? 0.5 : 2.5;
    plan.wall_with_door(4 * i, 0, 4, 2.5, door, door + 0.9, 2);
  }
  for (int i = 0; i < 5; ++i) plan.box({4 * i + 1.0, 1.5, 0}, {4 * i + 1.5, 2.5, 0.7}, false);
  return plan;
}

}  // namespace enfilade::testing
