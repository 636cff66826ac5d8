// How a light's intensity depends on the direction: the one form of all photometric files, spot
// lights and tables in scene files.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/geometry.hpp"
#include "photometry/intensity_table.hpp"

namespace enfilade {

/// A direction drawn in proportion to the intensity.
struct SampledDirection {
  Vec3 toward{0.0};     ///< unit
  double weight = 1.0;  ///< what the share of the flux that it stands for is multiplied by
};

/// A cone about a unit direction.
struct ViewCone {
  Vec3 axis{0.0};
  double half_angle = 0.0;  ///< radians
};

/// The intensity is bilinear between the table's angles, and zero beyond them. Directions are in
/// the luminaire's own frame: x to the right (the half-plane C = 0), y up (C = 90), z along its
/// aim (gamma = 0). Type A and B angles of 0 and 0 point along the aim; horizontal angles grow to
/// the right, vertical ones upwards (ANSI/IES LM-63).
class IntensityDistribution {
 public:
  /// `table`: the table as a file has it; what its symmetry leaves out is added. Its intensities
  /// are finite, not negative and not all zero; its angles ascend. Throws std::invalid_argument
  /// with what is wrong.
  explicit IntensityDistribution(IntensityTable table);

  /// Returns the intensity (cd) towards v, a vector of any length but 0.
  double intensity(const Vec3& v) const;
  /// Returns the luminous flux (lm): the exact integral of the interpolated intensity.
  double flux() const { return flux_; }
  /// Returns the mean intensity over all directions: flux / (4 pi).
  double mean() const { return mean_; }
  double peak() const { return peak_; }

  /// Returns the flux (lm) into the solid angle of a convex planar polygon, whose corners are seen
  /// from the light; the plane does not contain the light. Exact in gamma, and by Gauss's rule
  /// along the edges to about 1e-5 of it: no beam within the polygon is missed, however narrow.
  double flux_within(std::span<const Vec3> corners) const;
  /// True where nothing leaves against the aim.
  bool is_dark_behind() const;
  /// Returns an upper bound (cd) of the intensity within the cone.
  double most_within(const ViewCone& cone) const;
  /// Draws a direction for uniform r1 and r2 in [0, 1).
  SampledDirection sample(double r1, double r2) const;

  /// Returns the part that leaves a surface whose normal is the aim: what goes to the back is cut
  /// off. Throws std::invalid_argument where nothing is left.
  IntensityDistribution front_half() const;

  /// The table as it was given.
  const IntensityTable& table() const { return given_; }

 private:
  friend class FluxInView;
  /// Where an angle lies between two entries of a list.
  struct Between {
    std::size_t low = 0;  ///< and low + 1
    double share = 0.0;   ///< of the upper one
  };
  struct Polar {
    double angle, azimuth;  ///< radians; about the table's axis
  };
  /// Flux per radian of azimuth from the axis to an angle, and up to the opposite axis.
  struct Cumulative {
    double to = 0.0, whole = 0.0;
  };

  Vec3 to_polar(const Vec3& v) const;
  Vec3 from_polar(const Vec3& v) const;
  bool find_plane(double azimuth, Between& between) const;
  std::size_t find_angle(double angle) const;
  double value(std::size_t plane, std::size_t low, double angle) const;
  double cumulative_in(std::size_t plane, std::size_t low, double angle) const;
  Cumulative cumulative(double angle, double azimuth) const;
  void index_angles();
  void sum_up();

  IntensityTable given_;
  PhotometryType type_;
  // Radians from here on. planes_ is empty where the light is the same all around.
  std::vector<double> planes_, angles_, candela_;
  std::vector<std::uint32_t> angle_at_degree_;  ///< the last entry at or below each degree
  std::vector<double> cumulative_;              ///< by plane and angle
  std::vector<double> ring_most_;               ///< by angle: the largest of all planes
  std::vector<double> cell_flux_;               ///< running sum over cells, for sample()
  double flux_ = 0.0, mean_ = 0.0, peak_ = 0.0, step_ = 0.1;
};

/// A spot light (glTF's KHR_lights_punctual): intensity 1 within the inner cone, and from there the
/// square of the cosine's share of the way, down to 0 at the outer cone. Angles from the axis,
/// radians, 0 <= inner <= outer <= pi.
IntensityDistribution spot_distribution(double inner, double outer);

}  // namespace enfilade
