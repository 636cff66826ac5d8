// Photometric files written from functions whose flux is known in closed form.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace enfilade::testing {

inline double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

inline std::vector<double> steps(double from, double to, double step) {
  std::vector<double> list;
  for (int i = 0; from + i * step <= to + 1e-9; ++i) list.push_back(from + i * step);
  return list;
}

inline std::string joined(const std::vector<double>& numbers, const char* between = " ") {
  std::string text;
  std::size_t in_line = 0;
  for (const double x : numbers) {
    text += fmt::format("{}{:.8g}", in_line == 0 ? "" : between, x);
    if (++in_line < 12) continue;
    text += "\r\n";
    in_line = 0;
  }
  return text + "\r\n";
}

/// Intensity by two angles in degrees: C and gamma, or horizontal and vertical.
using Intensity = std::function<double(double, double)>;

/// cos^n of gamma, and dark from 90 degrees on, peak 1: the flux is 2 pi / (n + 1).
inline Intensity cosine_power(double n) {
  return [n](double, double gamma) {
    return gamma >= 90.0 ? 0.0 : std::pow(std::cos(radians(gamma)), n);
  };
}
inline double flux_of_cosine_power(double n) { return 2.0 * std::numbers::pi / (n + 1.0); }

/// The parts of an LM-63 file, each to be changed by itself.
struct IesParts {
  std::string version = "IESNA:LM-63-2002";
  std::string keywords = "[TEST] none\r\n[MANUFAC] Own\r\n[LUMINAIRE] Corpus\r\n[LAMP] LED\r\n";
  std::string tilt = "TILT=NONE\r\n";
  double lamps = 1, lumens = -1, multiplier = 1;
  int type = 1, units = 2;
  double width = 0, length = 0, height = 0, ballast = 1, third = 1, watts = 10;
  std::vector<double> vertical = steps(0, 90, 1), horizontal = {0};
  Intensity intensity = cosine_power(1);
  double scale = 1000;
  std::string end;

  std::string text() const {
    std::string made = version.empty() ? "" : version + "\r\n";
    made += keywords + tilt;
    made += fmt::format("{:g} {:g} {:g} {} {} {} {} {:g} {:g} {:g}\r\n{:g} {:g} {:g}\r\n", lamps,
                        lumens, multiplier, vertical.size(), horizontal.size(), type, units, width,
                        length, height, ballast, third, watts);
    made += joined(vertical) + joined(horizontal);
    for (const double h : horizontal) {
      std::vector<double> row;
      for (const double v : vertical) row.push_back(scale * intensity(h, v));
      made += joined(row);
    }
    return made + end;
  }
};

/// The parts of a EULUMDAT file. `planes`: all of them, whatever the symmetry.
struct LdtParts {
  int symmetry = 1, lamps = 1;
  std::vector<double> planes = steps(0, 345, 15), angles = steps(0, 90, 1);
  Intensity intensity = cosine_power(1);
  double peak_per_klm = 200, factor = 1, flux = 2500, light_output = 0, watts = 30;
  double length = 600, width = 300, height = 0;
  std::string sets = "1";
  std::string more_lamps, end;

  std::vector<double> measured() const {
    std::vector<double> list;
    const std::size_t n = planes.size();
    const std::size_t first = symmetry == 3 ? 3 * n / 4 : 0;
    const std::size_t count = symmetry == 1   ? 1
                              : symmetry == 0 ? n
                              : symmetry == 4 ? n / 4 + 1
                                              : n / 2 + 1;
    for (std::size_t i = 0; i < count; ++i) list.push_back(planes[(first + i) % n]);
    return list;
  }

  std::string text() const {
    std::string made = "Own\r\n1\r\n";
    made += fmt::format("{}\r\n{}\r\n{:g}\r\n{}\r\n{:g}\r\n", symmetry, planes.size(),
                        planes.size() > 1 ? planes[1] - planes[0] : 0.0, angles.size(),
                        angles[1] - angles[0]);
    made += "report\r\nCorpus\r\nnumber\r\nfile\r\ntoday\r\n";
    made += fmt::format("{0:g}\r\n{1:g}\r\n50\r\n{0:g}\r\n{1:g}\r\n", length, width);
    for (int i = 0; i < 4; ++i) made += fmt::format("{:g}\r\n", height);
    made += fmt::format("100\r\n{:g}\r\n{:g}\r\n0\r\n", light_output, factor);
    made +=
        sets + fmt::format("\r\n{}\r\nLED\r\n{:g}\r\n4000\r\n80\r\n{:g}\r\n", lamps, flux, watts);
    made += more_lamps;
    for (int i = 0; i < 10; ++i) made += "0.5\r\n";
    for (const double c : planes) made += fmt::format("{:g}\r\n", c);
    for (const double g : angles) made += fmt::format("{:g}\r\n", g);
    for (const double c : measured())
      for (const double g : angles)
        made += fmt::format("{:.8g}\r\n", peak_per_klm / factor * intensity(c, g));
    return made + end;
  }
};

}  // namespace enfilade::testing
