// Depth-first search along the portal sequences that lines from a source can pass (§3.2; Teller
// 1992).
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "cells/partition/cell_complex.hpp"
#include "geometry/half_spaces.hpp"
#include "visibility/line_space.hpp"

namespace enfilade {

/// One way through a portal, as seen from inside a cell.
struct Doorway {
  std::uint32_t portal = 0;
  std::uint32_t number = 0;  ///< of the way: 2 * portal, or 2 * portal + 1 for the opposite way
  CellId leads_to;
  Polygon polygon;
  Plane plane;  ///< facing away from the cell
  Box box;
};

/// The doorways of each cell.
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

/// A view into a cell: the part of the doorway that lines pass, and the half spaces that they stay
/// in beyond it. Valid during the call alone.
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
/// Is the next window proved hidden? Then no sequence through it is followed. May be empty.
using IsHidden = std::function<bool(const WindowView&)>;

/// Calls `visit` for every cell that is entered, once for each portal sequence, depth first. A
/// doorway that has been passed `max_passes` times is passed once more on a path of its own: only
/// the source and the doorway itself limit the view beyond, which covers every further sequence
/// through it. The cost is therefore bounded by the number of doorways within reach, and no line is
/// ever left out. `is_hidden` is called before `visit`. Memory grows with the length of the
/// sequence, the call stack does not. Returns false where it gave up after `most_doorways` doorways
/// that were tried: cells may then be missing.
bool search_portals(const DoorwayMap& doorways, CellId start, std::span<const SourcePolygon> source,
                    int max_passes, const std::function<void(const CellView&)>& visit,
                    const IsHidden& is_hidden = {},
                    std::uint64_t most_doorways = std::numeric_limits<std::uint64_t>::max());

}  // namespace enfilade
