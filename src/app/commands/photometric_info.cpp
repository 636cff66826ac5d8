#include "app/commands/photometric_info.hpp"

#include <fmt/format.h>

#include "json/model_files.hpp"
#include "photometry/files/photometric_file.hpp"

namespace enfilade {
namespace {

void add_text(TextTable& table, const char* key, const std::string& text) {
  if (!text.empty()) table.add(key, text);
}

void add_beam(TextTable& table, const PhotometricFigures& figures) {
  if (figures.beam_0 <= 0.0) {
    table.add("beam angle", "none: the peak is not along the aim");
  } else {
    table.add("beam angle", fmt::format("{:.1f} degrees (C0-C180), {:.1f} degrees (C90-C270)",
                                        figures.beam_0, figures.beam_90));
  }
}

std::string angles_of(const IntensityTable& table) {
  return fmt::format("{} planes, {:g} to {:g} degrees; {} angles, {:g} to {:g} degrees",
                     table.planes.size(), table.planes.front(), table.planes.back(),
                     table.angles.size(), table.angles.front(), table.angles.back());
}

}  // namespace

void add_photometric_file(TextTable& table, const std::string& path, const Console& console) {
  Warnings warnings;
  ModelFiles files(path, false);
  const auto beside = [&](const std::string& name) -> std::optional<std::string> {
    const std::string side = ModelFiles::path_from(path, name);
    if (!files.allowed(side) || !ModelFiles::exists(side)) return std::nullopt;
    return files.read(side, {path, "TILT"});
  };
  const PhotometricFile file = read_photometric_file(files.read_model(), path, warnings, beside);
  const IntensityTable& intensities = file.distribution->table();
  const PhotometricFigures figures = figures_of(*file.distribution);
  table.add("format", file.format);
  add_text(table, "manufacturer", file.manufacturer);
  add_text(table, "luminaire", file.luminaire);
  add_text(table, "lamp", file.lamp);
  table.add("flux", fmt::format("{:.5g} lm", file.distribution->flux()));
  if (file.lamps_flux_lm > 0.0) {
    table.add("lamps' flux",
              fmt::format("{:.5g} lm ({:.1f} % leave the luminaire)", file.lamps_flux_lm,
                          100.0 * file.distribution->flux() / file.lamps_flux_lm));
  } else {
    table.add("photometry", "absolute");
  }
  if (file.power_w > 0.0) {
    table.add("power", fmt::format("{:.4g} W", file.power_w));
    table.add("efficacy", fmt::format("{:.4g} lm/W", file.distribution->flux() / file.power_w));
  }
  table.add("type", intensities.type == PhotometryType::c   ? "C"
                    : intensities.type == PhotometryType::b ? "B"
                                                            : "A");
  table.add("symmetry", symmetry_of(intensities));
  table.add("angles", angles_of(intensities));
  table.add("peak", fmt::format("{:.5g} cd at plane {:g}, angle {:g} degrees", figures.peak_cd,
                                figures.peak_plane, figures.peak_angle));
  add_beam(table, figures);
  table.add("opening", described(file.opening));
  if (!file.tilt.degrees.empty()) {
    table.add("tilt", fmt::format("lamps' flux x {:.3f} to {:.3f} from {:g} to {:g} degrees",
                                  file.tilt.factors.front(), file.tilt.factors.back(),
                                  file.tilt.degrees.front(), file.tilt.degrees.back()));
  }
  console.warnings(warnings);
}

}  // namespace enfilade
