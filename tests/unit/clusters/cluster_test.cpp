#include "clusters/cluster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "cells/partition/plane_set.hpp"
#include "cells/rooms/build_cells.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"

namespace enfilade {
namespace {

std::vector<CellPiece> cut_all(const plan::Plan& plan, const CellComplex& complex) {
  std::vector<CellPiece> parts;
  for (const Piece& piece : plan.pieces()) {
    for (CellPiece& part : complex.cut(piece)) parts.push_back(std::move(part));
  }
  return parts;
}

plan::Plan furnished() {
  plan::Plan plan = plan::two_rooms();
  for (int i = 0; i < 30; ++i) {
    const Vec3 lo(0.3 + 0.3 * i, 2.5, 0);
    plan.box(lo, lo + Vec3(0.2, 0.2, 0.4), false);
  }
  return plan;
}

TEST(Clusters, EveryPieceIsInOneClusterOfItsCell) {
  const plan::Plan plan = furnished();
  const CellComplex complex = build_cells(plan.pieces(), {});
  const auto parts = cut_all(plan, complex);
  const auto clusters = build_clusters(plan.scene(), parts, {});
  std::map<SurfaceId, double> area;
  std::size_t count = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    EXPECT_EQ(clusters[i].id, ClusterId(i));
    if (i > 0) {
      EXPECT_LE(clusters[i - 1].cell, clusters[i].cell);
    }
    for (const ClusterPolygon& polygon : clusters[i].polygons) {
      area[polygon.surface] += area_m2(polygon.polygon);
      ++count;
    }
  }
  EXPECT_EQ(count, parts.size());
  for (const Piece& piece : plan.pieces()) area[piece.surface] -= area_m2(piece.polygon);
  for (const auto& [surface, difference] : area) EXPECT_NEAR(difference, 0.0, 1e-9);
}

TEST(Clusters, WallsOfARoomAreNotMixed) {
  const plan::Plan plan = plan::one_room();
  const CellComplex complex = build_cells(plan.pieces(), {});
  const auto clusters = build_clusters(plan.scene(), cut_all(plan, complex), {});
  ASSERT_EQ(clusters.size(), 6u);
  for (const Cluster& cluster : clusters) EXPECT_EQ(cluster.polygons.size(), 1u);
}

TEST(Clusters, ObjectsOfTheFileStayTogether) {
  plan::Plan plan = furnished();
  Scene scene = plan.scene();
  const std::size_t boxes = plan.polygons.size() - 180;
  for (std::size_t i = boxes; i < scene.surfaces.size(); ++i) scene.surfaces[i].object = "row";
  const CellComplex complex = build_cells(plan.pieces(), {});
  std::size_t of_row = 0;
  for (const Cluster& cluster : build_clusters(scene, cut_all(plan, complex), {})) {
    EXPECT_LE(cluster.polygons.size(), ClusterConfig{}.max_polygons);
    for (const ClusterPolygon& polygon : cluster.polygons) {
      EXPECT_EQ(polygon.surface.index() >= boxes, cluster.object == "row");
    }
    of_row += cluster.object == "row" ? cluster.polygons.size() : 0;
  }
  EXPECT_GE(of_row, 150u);  // without the bottoms, which stand on the floor
}

TEST(Clusters, WithoutObjectsConnectedPolygonsAreOneCluster) {
  const plan::Plan plan = furnished();
  const CellComplex complex = build_cells(plan.pieces(), {});
  const std::size_t boxes = plan.polygons.size() - 180;
  for (const Cluster& cluster : build_clusters(plan.scene(), cut_all(plan, complex), {})) {
    const std::size_t first = cluster.polygons[0].surface.index();
    // The bottoms look out of the building: single polygons, which are pooled there.
    if (first < boxes || complex.cells()[cluster.cell.index()].kind == CellKind::outside) continue;
    for (const ClusterPolygon& polygon : cluster.polygons) {
      EXPECT_EQ((polygon.surface.index() - boxes) / 6, (first - boxes) / 6);
    }
  }
}

/// Its surfaces, cluster by cluster.
std::set<std::vector<SurfaceId>> grouping(const plan::Plan& plan) {
  const std::vector<Piece> pieces = plan.pieces();
  const CellComplex complex = build_cells(pieces, {});
  std::set<std::vector<SurfaceId>> groups;
  for (const Cluster& cluster :
       build_clusters(plan.scene(), cut_all(plan, complex), {}, dominant_frame(pieces))) {
    std::vector<SurfaceId> surfaces;
    for (const ClusterPolygon& polygon : cluster.polygons) surfaces.push_back(polygon.surface);
    std::sort(surfaces.begin(), surfaces.end());
    groups.insert(std::move(surfaces));
  }
  return groups;
}

TEST(Clusters, ATurnedBuildingHasTheSameClusters) {
  // Shelves in rows and columns, too many for one cluster: equal distances wherever it is halved.
  plan::Plan plan = plan::two_rooms();
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      plan.sheet({4.5 + 0.4 * i, 0.2 + 0.3 * j, 1.0}, {0.2, 0, 0}, {0, 0.2, 0});
    }
  }
  const auto upright = grouping(plan);
  EXPECT_GT(upright.size(), 12u);
  plan.transform(plan::turn_and_move(1e4));
  EXPECT_EQ(grouping(plan), upright);
}

TEST(ClusterBytes, ComeBackTheSame) {
  const plan::Plan plan = furnished();
  const CellComplex complex = build_cells(plan.pieces(), {});
  const auto clusters = build_clusters(plan.scene(), cut_all(plan, complex), {});
  const std::string bytes = to_bytes(clusters);
  const auto back = clusters_from_bytes(bytes);
  EXPECT_EQ(to_bytes(back), bytes);
  EXPECT_EQ(back.size(), clusters.size());
}

}  // namespace
}  // namespace enfilade
