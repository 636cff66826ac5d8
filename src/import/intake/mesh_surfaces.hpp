// From a model's faces to a scene's surfaces.
#pragma once

#include <cstdint>
#include <vector>

#include "base/warnings.hpp"
#include "geometry/convex_merge.hpp"
#include "import/intake/affine.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Spectra of three bands: red, green, blue.
struct ModelMaterial {
  std::string name;
  Spectrum reflectance{0.5, 0.5, 0.5};
  Spectrum exitance{0.0, 0.0, 0.0};
  bool two_sided = false;
  bool open = false;         ///< light passes: faces of it are left out
  Spectrum transmittance{};  ///< of panes, per band; empty: opaque
};

/// Colours of 0.95 and more are white in models, and may absorb light: a reflectance lies below 1.
/// Warns of what is outside [0, 0.95].
Spectrum reflectance_of(const Spectrum& colour, const std::string& where, Warnings& warnings);

/// Faces of one material and object.
struct ModelMesh {
  std::vector<Vec3> points;      ///< in the scene's coordinates
  std::vector<IndexLoop> faces;  ///< counter-clockwise from the front
  std::string name, object;
};

/// Fills a scene with surfaces, in the order of the calls.
class MeshSurfaces {
 public:
  /// More surfaces than this are a fault of the model, or of what repeats in it.
  static constexpr std::size_t most_surfaces = 4'000'000;

  MeshSurfaces(Scene& scene, Warnings& warnings) : scene_(scene), warnings_(warnings) {}

  /// Joins neighbouring triangles to convex polygons. Faces that cross themselves are left out with
  /// a warning; faces of no area without one. Throws InputError where points lie too far out, and
  /// where there are too many surfaces.
  void add(const ModelMesh& mesh, const ModelMaterial& material);
  /// Throws InputError unless `more` further surfaces are fine.
  void reserve(std::size_t more) const;

 private:
  void add_surface(Polygon vertices, const ModelMesh& mesh, const ModelMaterial& material);

  Scene& scene_;
  Warnings& warnings_;
};

/// Throws InputError where nothing of a model came, with the first of the warnings.
void check_shapes(const Scene& scene, const Warnings& warnings);

}  // namespace enfilade
