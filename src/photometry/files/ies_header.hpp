// The text of an LM-63 file taken apart: its year, keywords, TILT and numbers.
#pragma once

#include "photometry/files/photometric_file.hpp"
#include "photometry/files/photometric_text.hpp"

namespace enfilade {

/// Angles and intensities of an LM-63 file, in the file's order.
struct IesNumbers {
  double lamps = 1.0, lumens = -1.0, multiplier = 1.0;
  int type = 1, units = 2;
  double width = 0.0, length = 0.0, height = 0.0;
  double ballast_factor = 1.0, third_factor = 1.0, watts = 0.0;
  std::vector<double> vertical, horizontal;
  std::vector<double> candela;  ///< horizontal angle by horizontal angle
  std::size_t line = 0;         ///< where the first angle stands
};

struct IesText {
  int year = 1986;
  std::string manufacturer, luminaire, lamp;
  LampTilt tilt;
  IesNumbers numbers;
};

/// Finds counts that are stated wrong by the order of the angles, and commas that are decimal
/// signs by the count of the numbers; fails where the numbers cannot be told apart.
IesText read_ies_text(const std::vector<std::string>& lines, const SideFile& beside,
                      PhotometricReport& report);

}  // namespace enfilade
