// Depth-first search along the sequences of portals that lines from a source can take (§3.2;
// Teller).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "cells/partition/cell_complex.hpp"
#include "geometry/half_spaces.hpp"
#include "visibility/line_space.hpp"

namespace enfilade {

/// The portals of a cell, each seen from inside it.
struct Doorway {
  std::uint32_t portal = 0;
  std::uint32_t number = 0;  ///< of this way through the portal
  CellId leads_to;
  Polygon polygon;
  Plane plane;  ///< facing away from the cell
  Box box;
};

/// Doorways by cell, and which cells hang together at all.
class DoorwayMap {
 public:
  explicit DoorwayMap(const CellComplex& complex);
  std::span<const Doorway> of(CellId cell) const { return doorways_[cell.index()]; }
  std::size_t cells() const { return doorways_.size(); }
  std::size_t portals() const { return portals_; }
  double slack_m() const { return slack_m_; }

 private:
  std::vector<std::vector<Doorway>> doorways_;
  std::size_t portals_ = 0;
  double slack_m_ = 0.0;
};

/// A view into a cell: through which part of its doorway, and within which half spaces.
struct CellView {
  CellId cell;
  const Polygon& window;
  const HalfSpaces& within;
};

/// One-sided polygons that lines start from, with their planes.
struct SourcePolygon {
  Polygon polygon;
  Plane plane;
  std::uint32_t number = LineSpacePart::no_number;  ///< among the polygons of all clusters
};

/// Lines from a source through the windows of the portals passed so far, and the next one.
struct WindowView {
  std::span<const SourcePolygon* const> source;
  std::span<const Window> path;
  const Polygon& window;
  const Plane& plane;  ///< facing away from the source
};
/// Is the next window proved hidden? No sequence through it is followed then. May be empty.
using IsHidden = std::function<bool(const WindowView&)>;

/// Calls `visit` for every cell that is entered, once for each sequence of portals. A doorway that
/// has been passed `max_passes` times is passed once more with nothing but the source and the
/// doorway itself to say what is seen beyond, which covers every further sequence through it: the
/// cost is bounded by the number of doorways within reach, and no line is ever left out.
void search_portals(const DoorwayMap& doorways, CellId start, std::span<const SourcePolygon> source,
                    int max_passes, const std::function<void(const CellView&)>& visit,
                    const IsHidden& is_hidden = {});

}  // namespace enfilade
