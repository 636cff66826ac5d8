#include "clusters/building_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cells/rooms/build_cells.hpp"
#include "unit/cells/rooms/plan_scenes.hpp"

namespace enfilade {
namespace {

/// Rooms in a row, each with blocks in it; turned, so that no normal lies along an axis.
std::vector<Cluster> rooms_in_a_row() {
  plan::Plan plan;
  plan.box({0, 0, 0}, {20, 4, 2.5}, true);
  for (int i = 1; i < 5; ++i) plan.wall_with_door(4 * i, 0, 4, 2.5, 1, 1.9, 2);
  for (int i = 0; i < 5; ++i) {
    plan.box({4 * i + 1.0, 1.5, 0}, {4 * i + 1.5, 2.5, 0.7}, false);
    plan.box({4 * i + 3.0, 3.0, 0}, {4 * i + 3.5, 3.5, 0.7}, false);
  }
  plan.transform(plan::turn_and_move(10.0));
  const CellComplex complex = build_cells(plan.pieces(), {});
  std::vector<CellPiece> parts;
  for (const Piece& piece : plan.pieces()) {
    for (CellPiece& part : complex.cut(piece)) parts.push_back(std::move(part));
  }
  return build_clusters(plan.scene(), parts, {});
}

TEST(BuildingTree, EveryClusterIsALeafOnce) {
  const std::vector<Cluster> clusters = rooms_in_a_row();
  ASSERT_GT(clusters.size(), 30u);
  const BuildingTree tree(clusters);
  EXPECT_EQ(tree.nodes().size(), 2 * clusters.size() - 1);
  std::set<ClusterId> found;
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
    const BuildingTree::Node& node = tree.node(i);
    EXPECT_EQ(node.leaf(), node.cluster.valid());
    if (!node.leaf()) continue;
    EXPECT_TRUE(found.insert(node.cluster).second) << node.cluster.value;
    EXPECT_EQ(tree.leaf_of(node.cluster), i);
    ASSERT_EQ(node.end, node.begin + 1);
    EXPECT_EQ(tree.clusters()[node.begin], node.cluster);
    EXPECT_EQ(node.polygons, clusters[node.cluster.index()].polygons.size());
    EXPECT_EQ(node.bounds.lo, clusters[node.cluster.index()].bounds.lo);
    EXPECT_EQ(node.bounds.hi, clusters[node.cluster.index()].bounds.hi);
  }
  EXPECT_EQ(found.size(), clusters.size());
}

TEST(BuildingTree, ANodeIsTheSumOfItsChildren) {
  const BuildingTree tree(rooms_in_a_row());
  for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
    const BuildingTree::Node& node = tree.node(i);
    if (node.leaf()) continue;
    const BuildingTree::Node &left = tree.node(node.left), &right = tree.node(node.right);
    EXPECT_GT(node.left, i);  // sums are made from the last node to the first
    EXPECT_GT(node.right, i);
    EXPECT_EQ(node.begin, left.begin);
    EXPECT_EQ(left.end, right.begin);
    EXPECT_EQ(node.end, right.end);
    EXPECT_EQ(node.polygons, left.polygons + right.polygons);
    for (const BuildingTree::Node* child : {&left, &right}) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(node.bounds.lo[axis], child->bounds.lo[axis]);
        EXPECT_GE(node.bounds.hi[axis], child->bounds.hi[axis]);
      }
    }
    for (std::size_t k = 0; k < directions; ++k)
      EXPECT_NEAR(node.facing_m2[k], left.facing_m2[k] + right.facing_m2[k], 1e-9);
  }
}

TEST(BuildingTree, CellsAreContiguous) {
  const std::vector<Cluster> clusters = rooms_in_a_row();
  const BuildingTree tree(clusters);
  std::set<CellId> cells;
  for (const Cluster& cluster : clusters) cells.insert(cluster.cell);
  ASSERT_GE(cells.size(), 5u);
  EXPECT_EQ(std::set<CellId>(tree.cells().begin(), tree.cells().end()), cells);
  ASSERT_EQ(tree.cells().size(), cells.size());
  const BuildingTree::Node& root = tree.node(BuildingTree::root);
  EXPECT_EQ(root.first_cell, 0u);
  EXPECT_EQ(root.end_cell, cells.size());
  std::vector<std::uint32_t> places;
  for (const ClusterId cluster : tree.clusters())
    places.push_back(tree.place_of(clusters[cluster.index()].cell));
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end()));
  for (const BuildingTree::Node& node : tree.nodes()) {
    EXPECT_EQ(node.first_cell, places[node.begin]);
    EXPECT_EQ(node.end_cell, places[node.end - 1] + 1);
  }
  for (std::uint32_t place = 0; place < cells.size(); ++place)
    EXPECT_EQ(tree.place_of(tree.cells()[place]), place);
  EXPECT_EQ(tree.place_of(CellId(1000u)), CellId::none_value);
}

TEST(BuildingTree, CellsOfOneHalfLieToOneSide) {
  plan::Plan plan;
  plan.box({0, 0, 0}, {16, 4, 2.5}, true);
  for (int i = 1; i < 4; ++i) plan.wall_with_door(4 * i, 0, 4, 2.5, 1, 1.9, 2);
  const CellComplex complex = build_cells(plan.pieces(), {});
  std::vector<CellPiece> parts;
  for (const Piece& piece : plan.pieces()) {
    for (CellPiece& part : complex.cut(piece)) parts.push_back(std::move(part));
  }
  const BuildingTree tree(build_clusters(plan.scene(), parts, {}));
  const BuildingTree::Node& root = tree.node(BuildingTree::root);
  EXPECT_LT(tree.node(root.left).bounds.hi.x, 8.1);
  EXPECT_GT(tree.node(root.right).bounds.lo.x, 7.9);
}

TEST(BuildingTree, FacingAreaIsThatOfThePolygons) {
  const std::vector<Cluster> clusters = rooms_in_a_row();
  const BuildingTree tree(clusters);
  double all = 0.0;
  for (const Cluster& cluster : clusters) {
    for (const ClusterPolygon& polygon : cluster.polygons) all += area_m2(polygon.polygon);
  }
  std::array<double, directions> expected{};
  for (const Cluster& cluster : clusters) {
    for (const ClusterPolygon& polygon : cluster.polygons) {
      const Vec3 n = normal(polygon.polygon);
      for (std::size_t k = 0; k < directions; ++k) {
        const double cosine = k % 2 == 0 ? n[static_cast<int>(k / 2)] : -n[static_cast<int>(k / 2)];
        expected[k] += area_m2(polygon.polygon) * std::max(0.0, cosine);
      }
    }
  }
  const BuildingTree::Node& root = tree.node(BuildingTree::root);
  double sum = 0.0;
  for (std::size_t k = 0; k < directions; ++k) {
    EXPECT_NEAR(root.facing_m2[k], expected[k], 1e-9 * all);
    sum += root.facing_m2[k];
  }
  EXPECT_GT(sum, all);  // a normal along no axis has shares that sum to more than 1
  EXPECT_NEAR(tree.facing_m2(BuildingTree::root, {0, 0, 1}), expected[4], 1e-9 * all);
  EXPECT_NEAR(tree.facing_m2(BuildingTree::root, {0, -1, 0}), expected[3], 1e-9 * all);
  EXPECT_NEAR(tree.facing_m2(BuildingTree::root, Vec3(0.0)), 0.5 * sum, 1e-9 * all);
}

TEST(BuildingTree, OfNoClusterHasNoNodeAndOfOneHasALeaf) {
  EXPECT_TRUE(BuildingTree({}).nodes().empty());
  const std::vector<Cluster> clusters = rooms_in_a_row();
  const BuildingTree tree(std::span<const Cluster>(clusters).first(1));
  ASSERT_EQ(tree.nodes().size(), 1u);
  EXPECT_TRUE(tree.node(BuildingTree::root).leaf());
}

}  // namespace
}  // namespace enfilade
