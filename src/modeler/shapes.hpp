// The shapes that all of a building is made of: walls with holes, passages through them, boxes,
// prisms.
#pragma once

#include <optional>
#include <span>

#include "base/geometry.hpp"
#include "modeler/surface_sink.hpp"

namespace enfilade {

/// Returns a point of the plan at a height.
inline Vec3 raised(const Vec2& p, double z) { return {p.x, p.y, z}; }

/// A hole in a wall: its ends on the wall's line as seen from the side that reflects.
struct Hole {
  Vec2 left, right;
  double low_m = 0.0, high_m = 0.0;
};

/// An upright wall's face, `left` and `right` as seen from the side that reflects; around a hole,
/// three or four rectangles.
struct WallFace {
  Vec2 left, right;
  double low_m = 0.0, high_m = 0.0;
  std::optional<Hole> hole = std::nullopt;
};
void add_wall(SurfaceSink& sink, const WallFace& wall, const Finish& finish, const char* name);

/// Horizontal polygons over corners that run counter-clockwise seen from above.
void add_floor(SurfaceSink& sink, std::span<const Vec2> corners, double z, const Finish& finish,
               const char* name);
void add_ceiling(SurfaceSink& sink, std::span<const Vec2> corners, double z, const Finish& finish,
                 const char* name);

/// The way through a wall: a and b are left and right on the near face, c lies behind b, e behind
/// a.
struct ModelPassage {
  Vec2 a, b, c, e;
  double low_m = 0.0, high_m = 0.0;

  Hole near_hole() const { return {a, b, low_m, high_m}; }
  Hole far_hole() const { return {c, e, low_m, high_m}; }
};
/// Its four sides: jambs, lintel and threshold of a door; the reveal of a window.
void add_passage(SurfaceSink& sink, const ModelPassage& passage, const Finish& sides,
                 const Finish& bottom);

/// A right-handed frame that stands upright somewhere in the plan.
struct Frame {
  Vec2 origin{0.0}, x{1.0, 0.0}, y{0.0, 1.0};
  double z = 0.0;

  Vec3 at(double px, double py, double pz) const {
    return raised(origin + px * x + py * y, z + pz);
  }
  /// Returns the same frame at another place, in its own coordinates.
  Frame moved(double px, double py, double pz) const {
    return {origin + px * x + py * y, x, y, z + pz};
  }
};

/// A closed box between two corners of the frame, faces outward.
void add_box(SurfaceSink& sink, const Frame& frame, const Vec3& lo, const Vec3& hi,
             const Finish& finish, const char* name);
/// An upright prism over a regular polygon around the frame's origin, faces outward.
void add_prism(SurfaceSink& sink, const Frame& frame, int sides, double radius_m, double low_m,
               double high_m, const Finish& finish, const char* name);

}  // namespace enfilade
