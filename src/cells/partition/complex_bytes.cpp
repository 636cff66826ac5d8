// The cells, portals and nodes of a complex as bytes.
#include "base/byte_stream.hpp"
#include "cells/partition/cell_complex.hpp"

namespace enfilade {
namespace {

constexpr std::string_view mark = "enfilade-cells-1";

}  // namespace

std::string to_bytes(const CellComplex& complex) {
  ByteWriter out;
  out.put_mark(mark);
  out.put(complex.tolerance_m());
  out.put(static_cast<std::uint64_t>(complex.cells().size()));
  for (const Cell& cell : complex.cells()) {
    out.put(static_cast<std::uint32_t>(cell.kind));
    out.put(cell.bounds.lo);
    out.put(cell.bounds.hi);
    out.put(cell.volume_m3);
  }
  out.put(static_cast<std::uint64_t>(complex.portals().size()));
  for (const Portal& portal : complex.portals()) {
    out.put(portal.a.value);
    out.put(portal.b.value);
    out.put_all<std::uint32_t>(portal.polygon);
  }
  out.put(static_cast<std::uint64_t>(complex.nodes().size()));
  for (const BspNode& node : complex.nodes()) {
    out.put(node.plane.n);
    out.put(node.plane.d);
    out.put(node.front);
    out.put(node.back);
    out.put(node.cell.value);
  }
  return out.text();
}

CellComplex complex_from_bytes(std::string_view bytes) {
  ByteReader in(bytes, "cells");
  in.expect(mark);
  const auto tolerance_m = in.get<double>();
  std::vector<Cell> cells(in.get_count(sizeof(Vec3)));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Cell& cell = cells[i];
    cell.id = CellId(i);
    const auto kind = in.get<std::uint32_t>();
    if (kind > static_cast<std::uint32_t>(CellKind::solid)) throw RunError("cells: unknown kind");
    cell.kind = static_cast<CellKind>(kind);
    cell.bounds.lo = in.get<Vec3>();
    cell.bounds.hi = in.get<Vec3>();
    cell.volume_m3 = in.get<double>();
  }
  std::vector<Portal> portals(in.get_count(sizeof(Vec3)));
  for (std::size_t i = 0; i < portals.size(); ++i) {
    Portal& portal = portals[i];
    portal.id = PortalId(i);
    portal.a = CellId(in.get<std::uint32_t>());
    portal.b = CellId(in.get<std::uint32_t>());
    portal.polygon = in.get_all<Vec3, std::uint32_t>();
    if (portal.a.index() >= cells.size() || portal.b.index() >= cells.size()) {
      throw RunError("cells: a portal to no cell");
    }
  }
  std::vector<BspNode> nodes(in.get_count(sizeof(Vec3)));
  for (BspNode& node : nodes) {
    node.plane.n = in.get<Vec3>();
    node.plane.d = in.get<double>();
    node.front = in.get<std::int32_t>();
    node.back = in.get<std::int32_t>();
    node.cell = CellId(in.get<std::uint32_t>());
    const bool leaf = node.front < 0 && node.back < 0;
    // Children stand behind their parent, so that the way down ends.
    const auto is_child = [&](std::int32_t child) {
      return child > &node - nodes.data() && static_cast<std::size_t>(child) < nodes.size();
    };
    if (!leaf && !(is_child(node.front) && is_child(node.back)))
      throw RunError("cells: a node that there is not");
    if (node.cell.valid() && node.cell.index() >= cells.size())
      throw RunError("cells: a leaf of no cell");
  }
  in.expect_end();
  return {std::move(cells), std::move(portals), std::move(nodes), tolerance_m};
}

}  // namespace enfilade
