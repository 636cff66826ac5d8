// Light whose distribution is data: what ies2rad makes of a photometric file.
#pragma once

#include <memory>
#include <optional>

#include "import/radiance/radiance_primitive.hpp"
#include "json/model_files.hpp"
#include "scene/light.hpp"

namespace enfilade {

/// How source.cal corrects for the shape of the source, so that its light is that of the data.
enum class RadianceSource { flat, box, cylinder, sphere };

/// What a plane surface of the source sends: its distribution, in a frame whose aim is the
/// surface's normal, and the exitance per unit of radiance of its material.
struct RadianceFaceLight {
  std::shared_ptr<const IntensityDistribution> distribution;
  double exitance = 0.0;
};

/// A brightdata pattern of a light.
struct RadianceDistribution {
  RadianceSource source = RadianceSource::flat;
  /// Exitance per unit of radiance of the material, W/m2 per W/(sr m2), as a mean over the source:
  /// of a plane without a distribution it is pi.
  double exitance = 0.0;
  /// Of the data, in the frame that ies2rad uses: aim -z, C = 0 towards x, C = 90 towards y. Null
  /// where the data have another form; the flux is known all the same.
  std::shared_ptr<const IntensityDistribution> data;
  double factor = 1.0;   ///< on the data
  Vec3 size{0.0};        ///< of a box; diameter and height of a cylinder
  glm::dmat3 turn{1.0};  ///< of the pattern by its own arguments

  /// Returns the frame in space of a source that `linear` turns and scales.
  LightFrame frame(const glm::dmat3& linear) const;
  /// Returns what a surface with this unit normal sends; null where it sends nothing. `up`: gets
  /// the frame's up.
  RadianceFaceLight face_light(const glm::dmat3& linear, const Vec3& normal, Vec3& up) const;
};

/// Returns the distribution of a spotlight material: the same radiance within a cone (half angle in
/// radians, above 0) about a direction.
RadianceDistribution radiance_spot(const Vec3& direction, double half_angle);

/// Returns the distribution of a brightdata that corrects for the shape of the source (flatcorr,
/// boxcorr, cylcorr, corr of source.cal); none where it is another pattern. Throws InputError where
/// its data cannot be read.
std::optional<RadianceDistribution> radiance_distribution(const RadiancePrimitive& pattern,
                                                          ModelFiles& files);

}  // namespace enfilade
