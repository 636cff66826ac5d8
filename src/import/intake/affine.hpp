// Affine maps from a model's coordinates to a scene's, in double.
#pragma once

#include "geometry/polygon.hpp"
#include "import/intake/import_options.hpp"

namespace enfilade {

/// p -> linear p + shift.
struct Affine {
  glm::dmat3 linear{1.0};
  Vec3 shift{0.0};

  Vec3 operator()(const Vec3& p) const { return linear * p + shift; }
  /// Returns the map that does `inner` first, then this one.
  Affine after(const Affine& inner) const {
    return {linear * inner.linear, linear * inner.shift + shift};
  }
  bool mirrors() const { return glm::determinant(linear) < 0.0; }
};

/// Returns the map from a model's axes and unit to a scene's, which are metres and z up. `up` and
/// `metres_per_unit` are the format's own, for what the options leave open.
Affine to_scene(const ImportOptions& options, char up, double metres_per_unit);

}  // namespace enfilade
