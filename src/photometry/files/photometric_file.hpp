// Luminaires' photometric files: IES LM-63 (1986, 1991, 1995, 2002, 2019) and EULUMDAT.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/warnings.hpp"
#include "photometry/intensity_distribution.hpp"
#include "photometry/luminous_opening.hpp"

namespace enfilade {

/// By how much a lamp's flux changes where its luminaire is tilted from the measured position.
struct LampTilt {
  std::vector<double> degrees, factors;
  /// Returns the factor at an angle, linear between those listed; 1 where none are.
  double factor(double degrees_from_measured) const;
};

/// What a photometric file says. Intensities are absolute: candela, with all factors of the file.
struct PhotometricFile {
  std::string format;  ///< "IES LM-63-2002", "EULUMDAT"
  std::string manufacturer, luminaire, lamp;
  std::shared_ptr<const IntensityDistribution> distribution;
  LuminousOpening opening;
  LampTilt tilt;
  double power_w = 0.0;         ///< 0 where the file tells none
  double lamps_flux_lm = -1.0;  ///< of all lamps; below 0: absolute photometry, or not told
};

/// Returns the bytes of a file that another one names beside it; none where it is not to be had.
using SideFile = std::function<std::optional<std::string>(const std::string& name)>;

/// True for the endings .ies and .ldt, in any case.
bool is_photometric_file(const std::string& path);

/// Reads a file of either kind: by its ending, or by its text where that is another. What is
/// written by mistake and is clear is read with a warning; else throws InputError. `beside`: for
/// TILT=file.
PhotometricFile read_photometric_file(const std::string& bytes, const std::string& path,
                                      Warnings& warnings, const SideFile& beside = {});

/// What one asks of a distribution.
struct PhotometricFigures {
  double peak_cd = 0.0, peak_plane = 0.0, peak_angle = 0.0;  ///< degrees, as the table has them
  /// Full angles, degrees, within which the intensity is at least half of that along the aim, in
  /// the half-planes 0 and 180, and 90 and 270; 0 where the peak lies elsewhere.
  double beam_0 = 0.0, beam_90 = 0.0;
};
PhotometricFigures figures_of(const IntensityDistribution& distribution);

}  // namespace enfilade
