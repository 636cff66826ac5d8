// Estimates whether light reaches a point: random walks from the point end on black backs, in the
// open, or at a light.
#pragma once

#include <span>
#include <vector>

#include "base/random.hpp"
#include "cells/partition/cell_complex.hpp"
#include "geometry/box_tree.hpp"
#include "raycast/ray_scene.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Keeps references to the scene's lights and the pieces, which must outlive it.
class LightWalk {
 public:
  /// Each step of a walk starts `offset_m` in front of a polygon and tests two lights or emitting
  /// pieces by shadow rays: the one that was found last from a piece of the same cell, and one
  /// drawn at random, half the time among those nearest to the cell: in a large building hardly any
  /// other is in view. A walk ends without light after `max_bounces` steps; a step from a piece
  /// that is marked dark counts for eight, since hollows have many pieces.
  LightWalk(const Scene& scene, std::span<const CellPiece> pieces, double offset_m,
            int max_bounces);

  /// Marks a whole piece from which no walk has found light.
  void mark_dark(std::size_t piece) { faces_[piece].dark = true; }
  /// Returns the number of steps of all walks so far.
  std::uint64_t steps() const { return steps_; }
  /// True if any of `walks` walks from p, on piece `piece` with unit normal n, finds light.
  bool finds_light(std::size_t piece, const Vec3& p, const Vec3& n, int walks, Random& random);

 private:
  bool one_walk(std::size_t piece, Vec3 p, Vec3 n, Random& random);
  bool finds_light_from(std::size_t piece, const Vec3& p, const Vec3& n, Random& random);
  std::size_t draw_source(CellId cell, const Vec3& p, Random& random);
  Vec3 place_of(std::size_t source) const;
  bool sees(std::size_t light, const Vec3& p, const Vec3& n, Random& random) const;
  bool sees_light(const Vec3& p, const Vec3& n, const LightSource& light, Random& random) const;
  bool sees_emitter(const Vec3& p, const Vec3& n, std::uint32_t emitter, Random& random) const;

  struct Face {
    Vec3 n;
    bool emits, dark = false;
  };
  std::span<const LightSource> lights_;
  std::span<const CellPiece> pieces_;
  double offset_m_;
  int max_bounces_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> emitters_;
  BoxTree places_;                       ///< of all sources, lights first
  std::vector<std::size_t> last_found_;  ///< per cell: a light or, after them, an emitter
  std::vector<std::vector<std::uint32_t>> nearest_;  ///< per cell, once it is asked for: sources
  std::uint64_t steps_ = 0;
  RayScene rays_;
};

}  // namespace enfilade
