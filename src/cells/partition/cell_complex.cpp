// Locating points in the cells, and cutting pieces at their borders.
#include "cells/partition/cell_complex.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "geometry/convex.hpp"

namespace enfilade {
namespace {

enum class Place { front, back, both, in_plane };

Place place_of(const Polygon& polygon, const Plane& plane, double tolerance) {
  const DistanceRange range = distances(polygon, plane);
  const bool any_front = range.highest > tolerance, any_back = range.lowest < -tolerance;
  if (any_front && any_back) return Place::both;
  return any_front ? Place::front : any_back ? Place::back : Place::in_plane;
}

// Joins parts of one cell into one polygon where their hull is no larger than their sum.
void rejoin(std::vector<CellPiece>& parts, const Vec3& n) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t j = i + 1; j < parts.size();) {
      if (parts[i].cell != parts[j].cell) {
        ++j;
        continue;
      }
      const Polygon& a = parts[i].piece.polygon;
      const Polygon& b = parts[j].piece.polygon;
      std::vector<Vec3> points(a);
      points.insert(points.end(), b.begin(), b.end());
      Polygon hull = convex_hull(std::move(points), n);
      const double sum = area_m2(a) + area_m2(b);
      if (std::abs(area_m2(hull) - sum) > 1e-9 * sum) {
        ++j;
        continue;
      }
      parts[i].piece.polygon = std::move(hull);
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;  // what did not fit before may fit now
    }
  }
}

}  // namespace

CellComplex::CellComplex(std::vector<Cell> cells, std::vector<Portal> portals,
                         std::vector<BspNode> nodes, double tolerance_m)
    : cells_(std::move(cells)),
      portals_(std::move(portals)),
      nodes_(std::move(nodes)),
      tolerance_m_(tolerance_m) {}

std::size_t CellComplex::open_cells() const {
  const auto open = [](const Cell& cell) { return cell.kind != CellKind::solid; };
  return static_cast<std::size_t>(std::count_if(cells_.begin(), cells_.end(), open));
}

CellId CellComplex::locate(const Vec3& p) const {
  if (nodes_.empty()) return {};
  std::size_t at = 0;
  while (nodes_[at].front >= 0) {
    const BspNode& node = nodes_[at];
    at = static_cast<std::size_t>(node.plane.signed_distance(p) >= 0.0 ? node.front : node.back);
  }
  const CellId cell = nodes_[at].cell;
  if (!cell.valid() || cells_[cell.index()].kind == CellKind::solid) return {};
  return cell;
}

CellId CellComplex::outside() const {
  Box all;
  for (const Cell& cell : cells_) all.add(cell.bounds);
  return cells_.empty() ? CellId() : locate(all.hi + all.extent());
}

std::vector<CellPiece> CellComplex::cut(const Piece& piece) const {
  ENFILADE_CHECK(!nodes_.empty(), "a complex without cells");
  const Vec3 n = normal(piece.polygon);
  struct Job {
    std::size_t node;
    Polygon polygon;
  };
  std::vector<Job> jobs;
  jobs.push_back({0, piece.polygon});
  std::vector<CellPiece> parts;
  bool one_cell = true;
  while (!jobs.empty()) {
    Job job = std::move(jobs.back());
    jobs.pop_back();
    const BspNode& node = nodes_[job.node];
    if (node.front < 0) {
      one_cell = one_cell && (parts.empty() || parts.front().cell == node.cell);
      parts.push_back({node.cell, {piece.surface, std::move(job.polygon), piece.reversed}});
      continue;
    }
    const auto front = static_cast<std::size_t>(node.front);
    const auto back = static_cast<std::size_t>(node.back);
    switch (place_of(job.polygon, node.plane, tolerance_m_)) {
      case Place::front:
        jobs.push_back({front, std::move(job.polygon)});
        break;
      case Place::back:
        jobs.push_back({back, std::move(job.polygon)});
        break;
      case Place::in_plane:
        jobs.push_back({glm::dot(n, node.plane.n) >= 0.0 ? front : back, std::move(job.polygon)});
        break;
      case Place::both: {
        auto [before, behind] = split(job.polygon, node.plane, tolerance_m_);
        if (behind.size() >= 3) jobs.push_back({back, std::move(behind)});
        if (before.size() >= 3) jobs.push_back({front, std::move(before)});
        break;
      }
    }
  }
  if (one_cell && !parts.empty()) return {{parts.front().cell, piece}};
  rejoin(parts, n);
  return parts;
}

}  // namespace enfilade
