#include "app/commands/prepared_figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "visibility/cell_sights.hpp"

namespace enfilade {

namespace {

/// "123 of 456 pairs (27%)"; pairs of n different things.
std::string pairs(std::size_t found, std::size_t n) {
  const std::uint64_t all = n < 2 ? 0 : static_cast<std::uint64_t>(n) * (n - 1) / 2;
  const double percent =
      all > 0 ? 100.0 * static_cast<double>(found) / static_cast<double>(all) : 0.0;
  return fmt::format("{} of {} pairs ({:.3g}%)", with_thousands(found), with_thousands(all),
                     percent);
}

std::size_t cells_of(const Prepared& prepared, CellKind kind) {
  return static_cast<std::size_t>(std::ranges::count(prepared.cells.cells(), kind, &Cell::kind));
}

/// Of G_cell, between different cells that are no insides of solids.
std::size_t cell_pairs(const CellComplex& complex) {
  const auto open = [&](CellId cell) {
    return complex.cells()[cell.index()].kind != CellKind::solid;
  };
  const CellSights sights(complex, {});
  std::size_t pairs = 0;
  for (const Cell& cell : complex.cells()) {
    if (!open(cell.id)) continue;
    for (const CellId other : sights.seen_from(cell.id)) {
      const std::vector<CellId>& back = sights.seen_from(other);
      if (cell.id < other && open(other) && std::binary_search(back.begin(), back.end(), cell.id)) {
        ++pairs;
      }
    }
  }
  return pairs;
}

}  // namespace

void add_prepared_figures(TextTable& table, const Prepared& prepared) {
  const std::size_t n = prepared.clusters.size(), edges = prepared.graph.edges();
  std::size_t polygons = 0, most = 0;
  for (const Cluster& cluster : prepared.clusters) {
    polygons += cluster.polygons.size();
    most = std::max(most, cluster.polygons.size());
  }
  const auto each = [&](std::size_t total) {
    return n > 0 ? static_cast<double>(total) / static_cast<double>(n) : 0.0;
  };
  table.add("cells", fmt::format("{} ({} rooms, {} outside), and {} insides of solids",
                                 with_thousands(prepared.cells.open_cells()),
                                 with_thousands(cells_of(prepared, CellKind::room)),
                                 with_thousands(cells_of(prepared, CellKind::outside)),
                                 with_thousands(cells_of(prepared, CellKind::solid))));
  table.add("portals", with_thousands(prepared.cells.portals().size()));
  table.add("clusters", with_thousands(n));
  table.add("polygons a cluster",
            fmt::format("{:.1f} on average, {} at most", each(polygons), most));
  table.add("cells that see each other",
            pairs(cell_pairs(prepared.cells), prepared.cells.open_cells()));
  if (prepared.has_visibility) {
    table.add("clusters that see each other", pairs(edges, n));
    table.add("visible from a cluster", fmt::format("{:.1f} clusters on average", each(2 * edges)));
  }
  table.add("covered area", fmt::format("{:.4g} m2", prepared.covered_area_m2));
  table.add("tolerance", fmt::format("{:.3g} m", prepared.cells.tolerance_m()));
}

void add_leaks(TextTable& table, const std::vector<Leak>& leaks) {
  if (leaks.empty()) table.add("leaks", "none");
  for (const LeakKind kind : {LeakKind::gap, LeakKind::open_side, LeakKind::lost_room}) {
    const auto first = std::ranges::find(leaks, kind, &Leak::kind);
    if (first == leaks.end()) continue;
    std::string way;
    for (const Vec3& p : first->path) {
      way += fmt::format("{}({:.2f}, {:.2f}, {:.2f})", way.empty() ? "" : " -> ", p.x, p.y, p.z);
    }
    table.add(fmt::format("leaks: {}", name_of(kind)),
              fmt::format("{}; {} (all in leaks.json)",
                          with_thousands(static_cast<std::uint64_t>(
                              std::ranges::count(leaks, kind, &Leak::kind))),
                          way));
  }
}

void add_prepare_cost(TextTable& table, const Prepared& prepared) {
  std::string time = format_duration(prepared.prepare_s), memory;
  const char* separator = ": ";
  for (const PrepareStep& step : prepared.steps) {
    const std::string bytes = format_bytes(static_cast<double>(step.peak_rss_bytes));
    time += separator + step.name + " " + format_duration(step.wall_s);
    memory += separator + step.name + " " + bytes;
    separator = ", ";
  }
  table.add("time to prepare", time);
  if (prepared.steps.empty()) return;
  const auto peak = static_cast<double>(prepared.steps.back().peak_rss_bytes);
  table.add("peak memory up to each step", format_bytes(peak) + memory);
}

}  // namespace enfilade
