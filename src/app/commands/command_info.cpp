// enfilade info: the figures of a scene, of a run, or of a photometric file.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <set>

#include "app/commands/commands.hpp"
#include "app/commands/photometric_info.hpp"
#include "app/commands/prepared_figures.hpp"
#include "app/frame/shown_value.hpp"
#include "import/import_model.hpp"
#include "photometry/files/photometric_file.hpp"
#include "run/leak_file.hpp"
#include "run/stats_json.hpp"
#include "scene/equal_bands.hpp"
#include "scene/photopic.hpp"
#include "scene/scene_limits.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText info_help{
    "info",
    "Print the figures of a scene, of a RUN directory, or of a luminaire's photometric file",
    "Examples:\n  enfilade info scenes/duplex.json\n  enfilade info out/duplex\n"
    "  enfilade info downlight.ies\n\n"
    "Photometric files are IES LM-63 (.ies, all editions) and EULUMDAT (.ldt): their flux is the\n"
    "integral of their intensities, with all factors of the file. What such a file says wrong and "
    "is\n"
    "clear is read with a warning."};

std::string shown(const Spectrum& spectrum, const char* unit) {
  return fmt::format("{:.4g} {}", fmt::join(spectrum, ", "), unit);
}

struct InfoOptions {
  std::string input;  ///< scene file, RUN directory or photometric file
  bool allow_outside = false;
};

struct SceneFigures {
  Box bounds;
  double area_m2 = 0.0;
  std::size_t emitting = 0;
  Spectrum emitted, reflected_m2;
  std::set<std::string> objects;
};

SceneFigures measure(const Scene& scene) {
  SceneFigures figures;
  const auto bands = static_cast<std::size_t>(scene.bands);
  figures.emitted.assign(bands, 0.0);
  figures.reflected_m2.assign(bands, 0.0);
  for (const Surface& surface : scene.surfaces) {
    const double area = area_m2(surface.vertices) * (surface.two_sided ? 2.0 : 1.0);
    figures.area_m2 += area;
    figures.bounds.add(bounds(surface.vertices));
    if (!surface.object.empty()) figures.objects.insert(surface.object);
    bool emits = false;
    for (std::size_t band = 0; band < bands; ++band) {
      figures.emitted[band] += area * surface.exitance[band];
      figures.reflected_m2[band] += area * surface.reflectance[band];
      emits = emits || surface.exitance[band] > 0.0;
    }
    if (emits) ++figures.emitting;
  }
  for (const LightSource& light : scene.lights) {
    for (std::size_t band = 0; band < bands; ++band) {
      figures.emitted[band] += power_per_intensity(light) * light.intensity[band];
    }
  }
  return figures;
}

void add_lights(TextTable& table, const Scene& scene) {
  std::size_t spots = 0, luminaires = 0;
  for (const LightSource& light : scene.lights) {
    if (light.cone)
      ++spots;
    else if (light.distribution)
      ++luminaires;
  }
  table.add("point lights", with_thousands(scene.lights.size() - spots - luminaires));
  if (spots > 0) table.add("spot lights", with_thousands(spots));
  if (luminaires > 0) table.add("luminaires", with_thousands(luminaires));
  if (scene.sky) {
    const Spectrum outside = in_bands_of_file(scene, scene.sky->horizontal(false));
    table.add("sky", fmt::format("{:.4g} {} on a level plane outside", outside[0],
                                 irradiance_label(scene.unit)));
  }
}

void add_scene(TextTable& table, const Scene& scene) {
  SceneFigures figures = measure(scene);
  const Vec3 extent = figures.bounds.extent();
  for (double& r : figures.reflected_m2) r /= std::max(figures.area_m2, 1e-300);
  table.add("surfaces", with_thousands(scene.surfaces.size()));
  table.add("objects", with_thousands(figures.objects.size()));
  table.add("emitting surfaces", with_thousands(figures.emitting));
  const auto panes = std::ranges::count_if(scene.surfaces, &Surface::is_pane);
  if (panes > 0) table.add("panes", with_thousands(static_cast<std::uint64_t>(panes)));
  add_lights(table, scene);
  table.add("probes", with_thousands(scene.probes.size()));
  table.add("bands", std::to_string(bands_of_file(scene)));
  table.add("extent", fmt::format("{:.4g} x {:.4g} x {:.4g} m", extent.x, extent.y, extent.z));
  table.add("area", fmt::format("{:.6g} m2", figures.area_m2));
  table.add("mean reflectance", shown(in_bands_of_file(scene, figures.reflected_m2), ""));
  const Spectrum emitted = in_bands_of_file(scene, figures.emitted);
  table.add("emitted", shown(emitted, scene.unit == ExitanceUnit::lumen_per_m2 ? "lm" : "W"));
  table.add("luminous flux", fmt::format("{:.5g} lm", photopic(emitted, scene.unit)));
}

void run_info(const InfoOptions& options, const Console& console) {
  const std::string& input = options.input;
  TextTable table(input);
  if (is_photometric_file(input)) {
    add_photometric_file(table, input, console);
  } else if (std::error_code code; !std::filesystem::is_directory(input, code)) {
    Warnings warnings;
    const Scene scene = read_scene_or_model(input, warnings, options.allow_outside);
    check_limits(scene);
    add_scene(table, scene);
    console.warnings(warnings);
  } else {
    RunLock lock;
    lock.read(input);
    const Prepared prepared = load_prepared(input);
    add_scene(table, prepared.scene);
    add_prepared_figures(table, prepared);
    add_leaks(table, read_leaks(input));
    add_prepare_cost(table, prepared);
    const RunRecord stats = read_stats(input);
    for (const auto& [key, value] : stats.entries()) table.add(key, shown_value(key, value));
  }
  console.print(table.text());
}

void add_options(CLI::App& sub, InfoOptions& o) {
  sub.add_option("input", o.input, "Scene file, RUN directory, or photometric file (.ies, .ldt)")
      ->required();
  sub.add_flag("--allow-outside", o.allow_outside,
               "Read photometric files that a scene names outside its own folder");
}

}  // namespace

void add_info(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, info_help, add_options, run_info);
}

}  // namespace enfilade
