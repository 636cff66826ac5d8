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
  std::vector<Segment> contacts{};  ///< where other polygons touch or cross it: shadow borders
  /// Light passes it: it hides nothing. A two-sided pane is two polygons back to back, of which the
  /// front alone has a transmittance (per band, at normal incidence); so light is dimmed once.
  bool pane = false;
  Spectrum transmittance{};
  bool reversed = false;     ///< the back of a two-sided surface
  bool walked_dark = false;  ///< random walks found no light (unreachable_parts.hpp)
};

/// Polygons of one cell: an object, a polygon, or neighbouring polygons.
struct Cluster {
  ClusterId id;
  CellId cell;
  std::string object;  ///< the scene's object of all its polygons; empty where they differ
  std::vector<ClusterPolygon> polygons;
  Box bounds;
  double area_m2 = 0.0;
};

struct ClusterConfig {
  std::size_t max_polygons = 64;   ///< larger objects are split by position
  double max_extent_share = 0.25;  ///< longest side of such parts, of the cell's diagonal
  double large_share =
      0.25;  ///< polygons longer than this share of the cell are not mixed with others
  std::size_t pool_polygons =
      16;  ///< loose single polygons are pooled by neighbourhood up to this many
};

struct ContactConfig {
  double min_length_relative = 1e-3;  ///< of the scene's diagonal: shorter contacts are left out
  std::size_t most = 32;              ///< contacts kept for each polygon
};

/// Groups the cut pieces by cell; within a cell large polygons (walls, floors) by object and plane,
/// then the other pieces by the file's objects, then connected ones, then those that lie close.
/// Ids go by cell, reachable before unreachable, then by position. Every cluster lies in one cell
/// and is reachable or unreachable as a whole; every cell piece is in exactly one cluster. Sizes
/// are measured along `own`, the building's frame as dominant_frame gives it.
std::vector<Cluster> build_clusters(const Scene& scene, std::span<const CellPiece> pieces,
                                    const ClusterConfig& config,
                                    const Frame& own = {Vec3(0, 0, 1), Vec3(1, 0, 0),
                                                        Vec3(0, 1, 0)});

/// Says which polygons are panes, by the scene's surfaces; called once the scene has the bands that
/// are solved.
void set_panes(std::span<Cluster> clusters, const Scene& scene);

/// Makes the panes opaque, as they are to the heat radiation of a building's surfaces.
void make_panes_opaque(std::span<Cluster> clusters);

/// Returns the clusters as they are kept in a run's directory (versioned, in this machine's byte
/// order).
std::string to_bytes(std::span<const Cluster> clusters);
/// Throws RunError where the bytes are not clusters of this version.
std::vector<Cluster> clusters_from_bytes(std::string_view bytes);

}  // namespace enfilade
