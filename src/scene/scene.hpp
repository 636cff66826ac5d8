// A scene as its file has it, and the convex pieces that the solver works on.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/ids.hpp"
#include "base/warnings.hpp"
#include "geometry/polygon.hpp"
#include "scene/building.hpp"
#include "scene/light.hpp"

namespace enfilade {

/// An input polygon, as read: any number of vertices from 3, perhaps not planar or convex.
struct Surface {
  Polygon vertices;      ///< metres, counter-clockwise from the reflecting side
  Spectrum reflectance;  ///< per band, each in [0, 1)
  Spectrum exitance;     ///< per band, in the scene's exitance unit
  std::string name;      ///< may be empty
  std::string object;    ///< may be empty
  bool two_sided = false;
  /// How the light that it emits is distributed, its aim along the normal; null: as from a dull
  /// (Lambertian) surface. The exitance is the flux per area all the same.
  std::shared_ptr<const IntensityDistribution> distribution{};
  Vec3 up{0.0};               ///< of the distribution, about; 0 for any
  std::string switch_name{};  ///< of what it emits; may be empty
  /// Per band, of light that meets the surface at right angles; empty: opaque (scene/pane_law.hpp).
  Spectrum transmittance{};

  bool is_pane() const { return !transmittance.empty(); }
  bool emits() const {
    return std::ranges::any_of(exitance, [](double e) { return e > 0.0; });
  }
};

/// A place where irradiance is computed: on a plane through p with normal n.
struct Probe {
  Vec3 p{0.0};
  Vec3 n{0.0, 0.0, 1.0};
};

enum class ExitanceUnit { watt_per_m2, lumen_per_m2 };
/// "W/m2" or "lm/m2".
const char* name_of(ExitanceUnit unit);
/// Returns the label of an irradiance in this unit: "W/m2" or "lx".
const char* irradiance_label(ExitanceUnit unit);

struct Scene {
  std::string file;  ///< where it was read from, for messages
  int bands = 1;     ///< every spectrum has this many values
  /// By the first so many of the bands alone is decided whatever depends on how much light there
  /// is; the further ones are shares of their light (shares/share_scene.hpp). 0 = all bands.
  int lead_bands = 0;
  /// Per band of the file, where its value lies in the spectra; empty = as they are
  /// (scene/equal_bands.hpp).
  std::vector<std::size_t> band_of;
  ExitanceUnit unit = ExitanceUnit::watt_per_m2;
  std::vector<Surface> surfaces;
  std::vector<LightSource> lights;
  std::optional<Sky> sky{};  ///< as the file has it; make_sky_lights() makes lights of it
  std::vector<Probe> probes;
  BuildingData building;   ///< rooms are read from scene files, the rest comes from importers
  std::uint64_t hash = 0;  ///< XXH64 of the file's bytes
  std::string text;        ///< the very bytes that were hashed, of a file in our own format
};

/// A convex planar part of a surface. A surface gives one piece, or several where it was split,
/// or none where it was dropped or is covered. A two-sided surface gives a second, reversed set.
struct Piece {
  SurfaceId surface;
  Polygon polygon;
  bool reversed = false;  ///< of a two-sided surface's second set
};

struct PieceReport {
  /// Area left out: covered by a coplanar surface in front, or duplicated.
  double covered_area_m2 = 0.0;
  std::size_t dropped = 0;  ///< surfaces without area, and duplicates
  std::size_t split = 0;    ///< surfaces that were not planar or not convex
};

/// Makes the pieces: splits what is not planar or not convex, drops the degenerate and the
/// duplicated, and cuts away what a coplanar, same-facing surface covers (the emitting one is in
/// front, else the later one). Each of these adds a warning that names the surfaces, and so does a
/// surface that seems to face the wrong way. Coplanar surfaces that face opposite ways are both
/// kept whole (scene/coplanar.hpp says why). The pieces of one surface follow each other, in the
/// order of the file. Throws InputError for a self-intersecting polygon, for a vertex beyond 1e9 m,
/// and where no piece is left.
std::vector<Piece> make_pieces(const Scene& scene, Warnings& warnings,
                               PieceReport* report = nullptr);

}  // namespace enfilade
