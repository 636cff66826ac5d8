// Clusters: the unit of storage, ownership, scheduling and visibility (§3.2).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/ids.hpp"
#include "cells/partition/cell_complex.hpp"
#include "geometry/convex.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// A convex polygon of a cluster, and the scene's surface it comes from.
struct ClusterPolygon {
  SurfaceId surface;
  Polygon polygon;
  std::vector<Segment> contacts{};  ///< where others touch or cross it: light breaks there
};

/// Polygons of one cell: an object, a polygon, or neighbouring polygons.
struct Cluster {
  ClusterId id;
  CellId cell;
  std::string object;  ///< the scene's object that it comes from; empty where it is of several
  std::vector<ClusterPolygon> polygons;
  Box bounds;
  double area_m2 = 0.0;
};

struct ClusterConfig {
  std::size_t max_polygons = 64;   ///< larger objects are split by position
  double max_extent_share = 0.25;  ///< of their parts: longest side, of the cell's diagonal
  double large_share =
      0.25;  ///< polygons longer than this share of the cell are not mixed with others
  std::size_t pool_polygons =
      16;  ///< loose single polygons are pooled by neighbourhood up to this many
};

struct ContactConfig {
  double min_length_relative = 1e-3;  ///< of the scene's diagonal: shorter ones are left out
  std::size_t most = 32;              ///< a polygon
};

/// Groups the cut pieces by cell; within it large polygons (walls, floors) with the fellows of
/// their object and plane, then the file's objects, then what hangs together, then what lies close.
/// Ids go by cell, lit before sealed, then by position. Every cluster lies in one cell and is all
/// lit or all sealed, every cell piece is in exactly one cluster. Sizes are measured along `own`,
/// the building's frame as dominant_frame gives it.
std::vector<Cluster> build_clusters(const Scene& scene, std::span<const CellPiece> pieces,
                                    const ClusterConfig& config,
                                    const Frame& own = {Vec3(0, 0, 1), Vec3(1, 0, 0),
                                                        Vec3(0, 1, 0)});

/// The clusters as they are kept in a run's directory (versioned, in this machine's byte order).
std::string to_bytes(std::span<const Cluster> clusters);
/// Throws RunError where the bytes are not clusters of this version.
std::vector<Cluster> clusters_from_bytes(std::string_view bytes);

}  // namespace enfilade
