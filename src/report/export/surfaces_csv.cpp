#include "report/export/surfaces_csv.hpp"

#include <fmt/format.h>

#include <iterator>
#include <vector>

#include "base/safe_text.hpp"
#include "scene/equal_bands.hpp"

namespace enfilade {

namespace {

struct Sums {
  double area_m2 = 0.0;
  std::vector<double> irradiance, radiosity;  ///< times area
};

std::vector<Sums> sums_over_surfaces(const SolvedScene& solved) {
  const std::size_t bands = static_cast<std::size_t>(solved.scene.bands);
  std::vector<Sums> sums(solved.scene.surfaces.size());
  for (Sums& s : sums) s.irradiance.assign(bands, 0.0), s.radiosity.assign(bands, 0.0);
  for (const ClusterState& state : solved.states) {
    const PatchForest& forest = state.patches();
    const std::size_t terms = static_cast<std::size_t>(forest.terms());
    for (std::size_t k = 0; k < forest.polygons(); ++k) {
      Sums& s = sums[forest.frames()[k].surface.index()];
      const double area_m2 = forest.node(k).shape.area_m2;
      s.area_m2 += area_m2;
      // The first term is the value at the centroid, which is the mean of an affine function.
      for (std::size_t band = 0; band < bands; ++band) {
        s.irradiance[band] += area_m2 * forest.irradiance(k)[band * terms];
        s.radiosity[band] += area_m2 * forest.radiosity(k)[band * terms];
      }
    }
  }
  return sums;
}

}  // namespace

std::string surfaces_csv(const SolvedScene& solved) {
  std::string csv = "surface,name,object,area_m2";
  const auto out = std::back_inserter(csv);
  for (const char* quantity : {"irradiance", "radiosity"}) {
    const bool falling = quantity[0] == 'i';
    const char* unit = falling ? irradiance_label(solved.scene.unit) : name_of(solved.scene.unit);
    for (std::size_t band = 0; band < bands_of_file(solved.scene); ++band) {
      fmt::format_to(out, ",mean_{}_{} [{}]", quantity, band, unit);
    }
  }
  csv += "\n";
  const std::vector<Sums> sums = sums_over_surfaces(solved);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Surface& surface = solved.scene.surfaces[i];
    fmt::format_to(out, "{},{},{},{:.6g}", i, csv_field(surface.name), csv_field(surface.object),
                   sums[i].area_m2);
    for (const auto* light : {&sums[i].irradiance, &sums[i].radiosity}) {
      for (double power : in_bands_of_file(solved.scene, *light)) {
        if (sums[i].area_m2 > 0.0) {
          fmt::format_to(out, ",{:.6g}", power / sums[i].area_m2);
        } else {
          csv += ",";
        }
      }
    }
    csv += "\n";
  }
  return csv;
}

}  // namespace enfilade
