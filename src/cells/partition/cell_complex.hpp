// Space cut into cells (rooms, the outside, the insides of solids) that see each other through
// portals: G_cell's nodes and edges (§4.2 and [10] of the paper).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/ids.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// A node of the binary space partition: inner (plane, children) or leaf (cell).
struct BspNode {
  Plane plane;
  std::int32_t front = -1, back = -1;  ///< children; -1 at a leaf
  CellId cell;                         ///< at a leaf
};

enum class CellKind { room, outside, solid };

struct Cell {
  CellId id;
  CellKind kind = CellKind::room;
  Box bounds;            ///< clipped to the scene's bounds
  double volume_m3 = 0;  ///< clipped to the scene's bounds
};

/// A convex planar opening between two cells. Conservative: it covers every opening there.
struct Portal {
  PortalId id;
  CellId a, b;  ///< a lies in front of the polygon's plane, b behind
  Polygon polygon;
};

/// A part of a piece that lies in one cell (the cell that its front side looks into).
struct CellPiece {
  CellId cell;
  Piece piece;
  bool unreachable = false;  ///< estimated to receive no light (clusters/unreachable_parts.hpp)
};

class CellComplex {
 public:
  struct Config {
    double min_occlusion =
        0.1;  ///< share of a region's cross-section that a plane must cover to cut it
    double min_border_share =
        0.05;  ///< ... or this share of what covers the region's border, in a sprawling building
    double tolerance_relative =
        1e-5;  ///< coplanarity, relative to the scene's diagonal (at most 2 mm)
    std::size_t max_leaves = 200000;
  };

  CellComplex() = default;
  CellComplex(std::vector<Cell> cells, std::vector<Portal> portals, std::vector<BspNode> nodes,
              double tolerance_m);

  const std::vector<Cell>& cells() const { return cells_; }
  /// Returns the number of rooms and of outside cells: all cells but the insides of solids.
  std::size_t open_cells() const;
  const std::vector<Portal>& portals() const { return portals_; }
  const std::vector<BspNode>& nodes() const { return nodes_; }
  double tolerance_m() const { return tolerance_m_; }

  /// Returns the room or outside that p lies in; none inside a solid and where no cell was kept.
  CellId locate(const Vec3& p) const;
  /// Returns the cell that lies around the building; none where all rooms are closed. A scene that
  /// nothing encloses is one cell, a room, which lies around it as well.
  CellId outside() const;
  /// Cuts a piece at the cells' borders; a piece that lies in one cell is not cut. The complex must
  /// have nodes.
  std::vector<CellPiece> cut(const Piece& piece) const;

 private:
  std::vector<Cell> cells_;
  std::vector<Portal> portals_;
  std::vector<BspNode> nodes_;
  double tolerance_m_ = 0.0;
};

/// Returns the complex as it is kept in a run's directory (versioned, in this machine's byte
/// order).
std::string to_bytes(const CellComplex& complex);
/// Throws RunError where the bytes are not a complex of this version.
CellComplex complex_from_bytes(std::string_view bytes);

}  // namespace enfilade
