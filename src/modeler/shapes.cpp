#include "modeler/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

void add_rectangle(SurfaceSink& sink, const Vec2& left, const Vec2& right, double low, double high,
                   const Finish& finish, const char* name) {
  sink.add({raised(left, low), raised(right, low), raised(right, high), raised(left, high)}, finish,
           name);
}

}  // namespace

void add_wall(SurfaceSink& sink, const WallFace& wall, const Finish& finish, const char* name) {
  const auto part = [&](const Vec2& left, const Vec2& right, double low, double high) {
    add_rectangle(sink, left, right, low, high, finish, name);
  };
  if (!wall.hole) return part(wall.left, wall.right, wall.low_m, wall.high_m);
  const Hole& hole = *wall.hole;
  part(wall.left, hole.left, wall.low_m, wall.high_m);
  part(hole.right, wall.right, wall.low_m, wall.high_m);
  part(hole.left, hole.right, hole.high_m, wall.high_m);
  if (hole.low_m > wall.low_m) part(hole.left, hole.right, wall.low_m, hole.low_m);
}

void add_floor(SurfaceSink& sink, std::span<const Vec2> corners, double z, const Finish& finish,
               const char* name) {
  Polygon polygon;
  for (const Vec2& p : corners) polygon.push_back(raised(p, z));
  sink.add(std::move(polygon), finish, name);
}

void add_ceiling(SurfaceSink& sink, std::span<const Vec2> corners, double z, const Finish& finish,
                 const char* name) {
  Polygon polygon;
  for (const Vec2& p : corners) polygon.push_back(raised(p, z));
  std::reverse(polygon.begin(), polygon.end());
  sink.add(std::move(polygon), finish, name);
}

void add_passage(SurfaceSink& sink, const ModelPassage& p, const Finish& sides,
                 const Finish& bottom) {
  const Vec2 corners[] = {p.a, p.b, p.c, p.e};
  add_floor(sink, corners, p.low_m, bottom, "threshold");
  add_ceiling(sink, corners, p.high_m, sides, "lintel");
  add_wall(sink, {p.a, p.e, p.low_m, p.high_m}, sides, "jamb");
  add_wall(sink, {p.c, p.b, p.low_m, p.high_m}, sides, "jamb");
}

void add_box(SurfaceSink& sink, const Frame& frame, const Vec3& lo, const Vec3& hi,
             const Finish& finish, const char* name) {
  const auto corner = [&](int x, int y, int z) {
    return frame.at(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  sink.add({corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)}, finish, name);
  sink.add({corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)}, finish, name);
  sink.add({corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)}, finish, name);
  sink.add({corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)}, finish, name);
  sink.add({corner(1, 1, 0), corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1)}, finish, name);
  sink.add({corner(0, 1, 0), corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1)}, finish, name);
}

void add_prism(SurfaceSink& sink, const Frame& frame, int sides, double radius_m, double low_m,
               double high_m, const Finish& finish, const char* name) {
  std::vector<Vec2> ring;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    const Vec3 p = frame.at(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0);
    ring.emplace_back(p.x, p.y);
  }
  add_ceiling(sink, ring, frame.z + low_m, finish, name);
  add_floor(sink, ring, frame.z + high_m, finish, name);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    add_rectangle(sink, ring[i], ring[(i + 1) % ring.size()], frame.z + low_m, frame.z + high_m,
                  finish, name);
  }
}

}  // namespace enfilade
