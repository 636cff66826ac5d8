// Luminous intensities on a grid of angles, as photometric files have them, and the expansion of
// the symmetries that the files leave out.
#pragma once

#include <string>
#include <vector>

namespace enfilade {

/// Which axis the planes of measurement share (IES LM-75, CIE 121). Type C: the axis of the
/// luminaire's aim, planes turn about it (C-planes, angles gamma from the aim). Type B: the axis to
/// the luminaire's right; the "vertical" angle turns about it, the "horizontal" one is measured in
/// each plane. Type A: the vertical axis; the "horizontal" angle turns about it, the "vertical" one
/// is measured in each plane.
enum class PhotometryType { c, b, a };

/// Intensities, candela. `planes` are the angles about the axis, `angles` those within each plane,
/// both in degrees and ascending. Type C: planes within [0, 360], angles within [0, 180] from the
/// aim. Types A and B: both within [-180, 180]; type A's planes are its horizontal angles, type
/// B's its vertical ones.
struct IntensityTable {
  PhotometryType type = PhotometryType::c;
  std::vector<double> planes, angles;
  std::vector<double> candela;  ///< plane by plane: candela[plane * angles.size() + angle]

  double at(std::size_t plane, std::size_t angle) const {
    return candela[plane * angles.size() + angle];
  }
};

/// The symmetry that the planes of a type C table tell: "rotational", "quadrant", "bilateral"
/// or "none"; of types A and B "bilateral" where horizontal angles begin at 0.
std::string symmetry_of(const IntensityTable& table);

/// Returns the table with all its planes. Type C: one plane stands for all; planes from 0 to 90 are
/// mirrored to a half and then to the whole, from 0 to 180 and from 90 to 270 to the whole. Types
/// A and B: horizontal angles that begin at 0 are mirrored to the left. A circle that lacks its
/// last plane (0 to 345 by 15) is closed. Returns in `fault` what keeps it from that, and the table
/// unchanged.
IntensityTable expanded(const IntensityTable& table, std::string& fault);

}  // namespace enfilade
