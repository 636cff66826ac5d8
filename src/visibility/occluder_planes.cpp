// Occluders by plane, with a tree of boxes where a plane has many.
#include "visibility/occluder_planes.hpp"

#include <algorithm>
#include <cmath>

#include "cells/partition/plane_set.hpp"

namespace enfilade {
namespace {

constexpr std::size_t many_parts = 24;  // from here on a tree of boxes is faster than a loop
constexpr double flat_relative = 1e-9;  // of the diagonal: rounding, beside coordinates' own

double rounding(const Box& box) {
  const Vec3 largest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  const double coordinate = std::max({largest.x, largest.y, largest.z});
  return std::max(flat_relative * box.diagonal(), 1e-15 * coordinate);
}

}  // namespace

OccluderPlanes::OccluderPlanes(std::span<const Polygon> polygons, std::span<const char> left_out) {
  Box box;
  for (const Polygon& p : polygons) box.add(bounds(p));
  if (box.empty()) return;
  const double flat_m = rounding(box);
  sliver_m_ = 4.0 * flat_m;
  // A polygon that is not flat blocks as it does in the ray tracer: as a fan of triangles.
  std::vector<Piece> parts;
  std::vector<std::uint32_t> of;
  for (std::uint32_t i = 0; i < polygons.size(); ++i) {
    const Polygon& p = polygons[i];
    flat_.push_back(lies_in(p, plane_of(p), flat_m));
    if (!left_out.empty() && left_out[i] != 0) continue;
    if (flat_.back()) {
      parts.push_back({SurfaceId(i), p});
      of.push_back(i);
      continue;
    }
    for (std::size_t k = 2; k < p.size(); ++k) {
      parts.push_back({SurfaceId(i), {p[0], p[k - 1], p[k]}});
      of.push_back(i);
    }
  }
  const PlaneSet set = find_planes(parts, flat_m);
  plane_of_polygon_.assign(polygons.size(), 0);
  for (const Plane& plane : set.planes) planes_.push_back({plane, {}, nullptr});
  for (std::size_t k = parts.size(); k-- > 0;) {
    const std::uint32_t plane = set.plane_of_piece[k];
    plane_of_polygon_[of[k]] = plane;
    Box part_box = bounds(parts[k].polygon);
    planes_[plane].parts.push_back({std::move(parts[k].polygon), part_box, of[k]});
  }
  for (Occluders& o : planes_) {
    if (o.parts.size() < many_parts) continue;
    std::vector<Box> boxes;
    for (const Part& part : o.parts) boxes.push_back(part.box);
    o.tree = std::make_unique<BoxTree>(boxes);
  }
}

std::vector<Polygon> OccluderPlanes::uncovered(std::uint32_t k, std::vector<Polygon> openings,
                                               std::span<const std::uint32_t> skip,
                                               std::size_t max_pieces) const {
  const Occluders& occluders = planes_[k];
  const auto cover = [&](const Part& part) {
    if (std::binary_search(skip.begin(), skip.end(), part.of)) return;
    std::vector<Polygon> left;
    for (Polygon& opening : openings) {
      if (!bounds(opening).overlaps(part.box, 0.0)) {
        left.push_back(std::move(opening));
        continue;
      }
      for (Polygon& rest : subtract_coplanar(opening, part.polygon, sliver_m_)) {
        if (rest.size() >= 3) left.push_back(std::move(rest));
      }
    }
    openings = std::move(left);
  };
  if (occluders.tree == nullptr) {
    for (const Part& part : occluders.parts) {
      if (openings.empty() || openings.size() > max_pieces) break;
      cover(part);
    }
    return openings;
  }
  Box box;
  for (const Polygon& opening : openings) box.add(bounds(opening));
  for (const std::uint32_t i : occluders.tree->touching(box, 0.0)) {
    if (openings.empty() || openings.size() > max_pieces) break;
    cover(occluders.parts[i]);
  }
  return openings;
}

}  // namespace enfilade
