#include "photometry/files/ies_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "photometry/files/ies_header.hpp"
#include "photometry/files/table_axes.hpp"

namespace enfilade {
namespace {

/// The product of the file's factors on all intensities.
double candela_factor(const IesText& text, PhotometricReport& report) {
  const IesNumbers& n = text.numbers;
  double product = 1.0;
  // Behind the ballast factor stands the ballast-lamp photometric factor until 1995, then a number
  // without meaning, and since 2019 the file's generation.
  const double third = text.year >= 2002 ? 1.0 : n.third_factor;
  for (const auto& [factor, name] : {std::pair{n.multiplier, "candela multiplier"},
                                     {n.ballast_factor, "ballast factor"},
                                     {third, "ballast-lamp photometric factor"}}) {
    if (factor < 0.0) {
      report.fail("header", fmt::format("has a {} of {:g}", name, factor),
                  "write the factor on its intensities, mostly 1");
    }
    if (factor == 0.0) report.warn(fmt::format("has a {} of 0: taken as 1", name));
    product *= factor > 0.0 ? factor : 1.0;
  }
  return product;
}

IntensityTable table_of(const IesText& text, PhotometricReport& report) {
  const IesNumbers& n = text.numbers;
  const auto [low, high] = std::minmax_element(n.vertical.begin(), n.vertical.end());
  int type = n.type;
  if (type < 1 || type > 3) {
    if (*low < 0.0) report.fail("header", "has no known type of photometry", "write 1, 2 or 3");
    report.warn(fmt::format("has the type of photometry {}: taken as 1 (type C)", n.type));
    type = 1;
  }
  if (type == 1 && (*low < 0.0 || *high > 180.0)) {
    report.fail(n.line, "has vertical angles outside 0 to 180 degrees in photometry of type C",
                "correct the angles, or the type (2 = B, 3 = A)");
  }
  const double factor = candela_factor(text, report);
  IntensityTable table;
  table.type = type == 1 ? PhotometryType::c : type == 2 ? PhotometryType::b : PhotometryType::a;
  table.planes = n.horizontal;
  table.angles = n.vertical;
  table.candela = n.candela;
  for (double& cd : table.candela) cd *= factor;
  if (type == 1 && *std::min_element(table.planes.begin(), table.planes.end()) < 0.0) {
    report.warn("has horizontal angles below 0: counted on from 360");
    for (double& plane : table.planes) plane += plane < 0.0 ? 360.0 : 0.0;
  }
  put_in_order(table, report);
  if (type != 2) return table;
  // In each plane of type B lie the horizontal angles.
  IntensityTable turned{table.type, table.angles, table.planes, {}};
  for (std::size_t v = 0; v < table.angles.size(); ++v)
    for (std::size_t h = 0; h < table.planes.size(); ++h) turned.candela.push_back(table.at(h, v));
  return turned;
}

LuminousOpening opening_of(const IesText& text, PhotometricReport& report) {
  const IesNumbers& n = text.numbers;
  double metres = n.units == 1 ? 0.3048 : 1.0;
  if (n.units != 1 && n.units != 2)
    report.warn(fmt::format("has the type of units {}: taken as 2 (metres)", n.units));
  const double largest = std::max({std::abs(n.width), std::abs(n.length), std::abs(n.height)});
  constexpr double unlikely = 20.0;
  if (largest > unlikely && largest <= 10'000.0) {
    report.warn(fmt::format("has an opening of {:g} {}: taken as millimetres", largest,
                            n.units == 1 ? "feet" : "metres"));
    metres = 0.001;
  } else if (largest > unlikely) {
    report.fail("header", "has an opening of more than 10 km", "write feet (1) or metres (2)");
  }
  bool known = true;
  const LuminousOpening opening =
      opening_by_lm63(text.year, metres * n.width, metres * n.length, metres * n.height, known);
  if (!known) {
    report.warn(
        fmt::format("has an opening of {:g} x {:g} x {:g}, which LM-63-{} does not know: "
                    "taken as {}",
                    n.width, n.length, n.height, text.year, described(opening)));
  }
  return opening;
}

/// A multiplier that was forgotten or applied twice shows in light that the lamps do not have.
void compare_with_lamps(PhotometricFile& file, const IesNumbers& n, PhotometricReport& report) {
  if (n.lumens < 0.0) {
    if (n.lumens != -1.0)
      report.warn(
          fmt::format("has {:g} lumens a lamp: taken as absolute photometry (-1)", n.lumens));
    return;
  }
  const double lamps = n.lamps > 0.0 ? n.lamps : 1.0;
  if (!(n.lamps > 0.0)) report.warn(fmt::format("has {:g} lamps: taken as 1", n.lamps));
  if (n.lumens == 0.0) {
    report.warn("tells 0 lumens a lamp: its intensities are taken as they are");
    return;
  }
  file.lamps_flux_lm = lamps * n.lumens;
  const double share = file.distribution->flux() / file.lamps_flux_lm;
  if (share > 1.05 || share < 0.05) {
    report.warn(
        fmt::format("gives {:.4g} lm, {:.3g} % of its lamps' {:.4g} lm: its candela "
                    "multiplier or lumens may be wrong",
                    file.distribution->flux(), 100.0 * share, file.lamps_flux_lm));
  }
}

}  // namespace

std::shared_ptr<const IntensityDistribution> distribution_of(IntensityTable table,
                                                             PhotometricReport& report) {
  try {
    return std::make_shared<const IntensityDistribution>(std::move(table));
  } catch (const std::invalid_argument& fault) {
    report.fail("angles", fault.what(), "correct the file, or get it again");
  }
}

PhotometricFile read_ies(const std::vector<std::string>& lines, const SideFile& beside,
                         PhotometricReport& report) {
  const IesText text = read_ies_text(lines, beside, report);
  PhotometricFile file;
  file.format = "IES LM-63-" + std::to_string(text.year);
  file.manufacturer = text.manufacturer;
  file.luminaire = text.luminaire;
  file.lamp = text.lamp;
  file.tilt = text.tilt;
  file.power_w = std::max(0.0, text.numbers.watts);
  file.distribution = distribution_of(table_of(text, report), report);
  file.opening = opening_of(text, report);
  compare_with_lamps(file, text.numbers, report);
  return file;
}

}  // namespace enfilade
