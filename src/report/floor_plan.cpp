#include "report/floor_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "report/storeys.hpp"

namespace enfilade {

namespace {

/// Convex parts of the level section at height z, each in one cell.
void section_of(const CellComplex& cells, std::int32_t node, const Polygon& polygon,
                std::map<std::uint32_t, std::vector<Polygon>>& parts) {
  if (polygon.size() < 3) return;
  const BspNode& n = cells.nodes()[static_cast<std::size_t>(node)];
  if (n.front < 0 && n.back < 0) {
    if (n.cell.valid()) parts[n.cell.value].push_back(polygon);
    return;
  }
  // A plane that lies in the section's plane has it all on one side.
  const bool level = std::abs(n.plane.n.z) > 1.0 - 1e-9;
  auto [front, back] =
      level ? std::pair<Polygon, Polygon>{} : split(polygon, n.plane, cells.tolerance_m());
  if (level) (n.plane.signed_distance(polygon[0]) >= 0.0 ? front : back) = polygon;
  if (n.front >= 0) section_of(cells, n.front, front, parts);
  if (n.back >= 0) section_of(cells, n.back, back, parts);
}

/// The plan's drawing: metres, y up turned into SVG's y down.
class Drawing {
 public:
  Drawing(const Box& box) : box_(box) {}
  void open(const std::string& title) {
    const Vec3 size = box_.extent();
    const double margin = 0.02 * std::max(size.x, size.y);
    fmt::format_to(
        out(),
        R"(<svg class="plan" role="img" aria-label="{}" viewBox="{:.2f} {:.2f} {:.2f} {:.2f}">)",
        title, -margin, -margin, size.x + 2 * margin, size.y + 2 * margin);
  }
  void close() { svg += "</svg>"; }
  std::string point(const Vec3& p) const {
    return fmt::format("{:.2f} {:.2f}", p.x - box_.lo.x, box_.hi.y - p.y);
  }
  void fill(const std::vector<Polygon>& parts, const std::string& colour, const std::string& tip) {
    fmt::format_to(out(), R"(<path class="cell" fill="{}" stroke="{}" d=")", colour, colour);
    for (const Polygon& part : parts) {
      for (std::size_t i = 0; i < part.size(); ++i) {
        fmt::format_to(out(), "{}{}", i == 0 ? "M" : "L", point(part[i]));
      }
      svg += "Z";
    }
    fmt::format_to(out(), R"("><title>{}</title></path>)", tip);
  }
  void lines(const std::vector<std::pair<Vec3, Vec3>>& segments) {
    svg += R"(<path class="wall" d=")";
    for (const auto& [a, b] : segments) fmt::format_to(out(), "M{}L{}", point(a), point(b));
    svg += "\"/>";
  }
  void dot(const Vec3& p, double radius_m, const std::string& colour, const std::string& tip) {
    fmt::format_to(
        out(),
        R"(<circle class="cluster" cx="{:.2f}" cy="{:.2f}" r="{:.2f}" fill="{}"><title>{}</title></circle>)",
        p.x - box_.lo.x, box_.hi.y - p.y, radius_m, colour, tip);
  }
  std::string svg;

 private:
  std::back_insert_iterator<std::string> out() { return std::back_inserter(svg); }
  Box box_;
};

/// Where polygons that stand cross the section.
std::vector<std::pair<Vec3, Vec3>> wall_lines(const SolvedScene& solved, double z_m) {
  std::vector<std::pair<Vec3, Vec3>> lines;
  for (const Cluster& cluster : solved.clusters) {
    if (cluster.bounds.lo.z > z_m || cluster.bounds.hi.z < z_m) continue;
    for (const ClusterPolygon& polygon : cluster.polygons) {
      std::vector<Vec3> crossings;
      const Polygon& p = polygon.polygon;
      for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec3 &a = p[i], &b = p[(i + 1) % p.size()];
        if ((a.z < z_m) == (b.z < z_m)) continue;
        crossings.push_back(a + (z_m - a.z) / (b.z - a.z) * (b - a));
      }
      if (crossings.size() == 2) lines.emplace_back(crossings[0], crossings[1]);
    }
  }
  return lines;
}

/// The rank that has most of each cell's surface; -1 for a cell without clusters.
std::vector<int> rank_of_cells(const SolvedScene& solved, std::span<const Rank> owner) {
  std::vector<std::map<int, double>> area(solved.cells.cells().size());
  for (std::size_t c = 0; c < std::min(owner.size(), solved.clusters.size()); ++c) {
    const Cluster& cluster = solved.clusters[c];
    if (cluster.cell.valid() && cluster.cell.index() < area.size()) {
      area[cluster.cell.index()][owner[c].value] += cluster.area_m2;
    }
  }
  std::vector<int> ranks;
  for (const auto& shares : area) {
    int best = -1;
    double most = 0.0;
    for (const auto& [rank, m2] : shares) {
      if (m2 > most) most = m2, best = rank;
    }
    ranks.push_back(best);
  }
  return ranks;
}

std::string kind_colour(CellKind kind) {
  if (kind == CellKind::solid) return "var(--solid)";
  return kind == CellKind::outside ? "var(--outside)" : "var(--room)";
}

FloorPlan draw(const SolvedScene& solved, std::span<const Rank> owner, const Storey& storey,
               int number) {
  const Box box = room_bounds(solved);
  const double z_m = storey.floor_m + std::min(1.2, 0.45 * storey.headroom_m);
  FloorPlan plan;
  plan.title = fmt::format("storey {}, cut at {:.2f} m", number, z_m);
  Drawing drawing(box);
  drawing.open(plan.title);
  std::map<std::uint32_t, std::vector<Polygon>> parts;
  const Polygon whole{{box.lo.x, box.lo.y, z_m},
                      {box.hi.x, box.lo.y, z_m},
                      {box.hi.x, box.hi.y, z_m},
                      {box.lo.x, box.hi.y, z_m}};
  if (!solved.cells.nodes().empty()) section_of(solved.cells, 0, whole, parts);
  const std::vector<int> ranks = rank_of_cells(solved, owner);
  for (const auto& [cell, polygons] : parts) {
    const CellKind kind = solved.cells.cells()[cell].kind;
    const bool owned = kind == CellKind::room && ranks[cell] >= 0;
    const std::string colour = owned ? rank_colour(ranks[cell]) : kind_colour(kind);
    const std::string tip =
        owned ? fmt::format("cell {}, rank {}", cell, ranks[cell]) : fmt::format("cell {}", cell);
    drawing.fill(polygons, colour, tip);
  }
  drawing.lines(wall_lines(solved, z_m));
  const double dot_m = 0.0024 * std::max(box.extent().x, box.extent().y);
  for (std::size_t c = 0; c < std::min(owner.size(), solved.clusters.size()); ++c) {
    const Vec3 p = solved.clusters[c].bounds.center();
    if (p.z < storey.floor_m - 0.1 || p.z > storey.floor_m + storey.headroom_m + 0.1) continue;
    drawing.dot(p, dot_m, rank_colour(owner[c].value),
                fmt::format("cluster {}, rank {}", c, owner[c].value));
  }
  drawing.close();
  plan.svg = std::move(drawing.svg);
  return plan;
}

}  // namespace

std::string rank_colour(int rank) {
  // Ten colours that stay apart for most eyes, then hues by the golden angle.
  constexpr const char* first[] = {"#4e79a7", "#f28e2b", "#59a14f", "#e15759", "#76b7b2",
                                   "#edc948", "#b07aa1", "#9c755f", "#ff9da7", "#8a8580"};
  if (rank >= 0 && rank < 10) return first[rank];
  return fmt::format("hsl({:.0f} {}% {}%)", std::fmod(rank * 137.508, 360.0), 45 + rank * 7 % 25,
                     48 + rank * 5 % 20);
}

std::vector<FloorPlan> floor_plans(const SolvedScene& solved, std::span<const Rank> owner) {
  std::vector<FloorPlan> plans;
  for (const Storey& storey : storeys(solved)) {
    plans.push_back(draw(solved, owner, storey, static_cast<int>(plans.size()) + 1));
  }
  return plans;
}

}  // namespace enfilade
