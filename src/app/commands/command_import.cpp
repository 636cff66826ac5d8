// enfilade import: a model of another program becomes a scene file.
#include <fmt/format.h>

#include "app/commands/commands.hpp"
#include "app/frame/option_checks.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "import/import_model.hpp"
#include "import/luminaire_files.hpp"
#include "light_survey/light_survey.hpp"
#include "scene/photopic.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText import_help{
    "import", "Make a scene file from a glTF, OBJ, IFC or Radiance model",
    "Examples:\n  enfilade import house.glb -o house.json\n"
    "  enfilade import plan.obj --units mm --up z -o plan.json\n"
    "  enfilade import materials.rad room.rad -o room.json\n"
    "  enfilade import house.ifc --luminaires photometry -o house.json\n\n"
    "Lengths are metres with y up (glTF, OBJ) or z up (Radiance), unless --units and --up tell\n"
    "otherwise; IFC names its own. Base colour becomes reflectance, emission becomes exitance:\n"
    "lm/m2 where the model has luminances (glTF, OBJ), W/m2 of a Radiance model's radiances.\n"
    "Materials give three bands: red, green, blue. Textures and vertex colours count by their "
    "mean\n"
    "in linear light. What passes more than half of the light is left out, and light passes.\n\n"
    "IFC (2x3, 4, 4.3) needs Node.js. Its spaces become \"rooms\" of the scene file, doors, "
    "windows\n"
    "and bare openings \"portals\", light fixtures \"luminaires\", and point lights where their "
    "flux\n"
    "is told. With --luminaires a folder's photometric files (.ies, .ldt) give lamps their real\n"
    "distribution: the file that bears the name of the lamp's type, whatever its case and signs.\n"
    "A flux that the model tells scales the file's. Spot lights of glTF, and what ies2rad makes "
    "of\n"
    "a photometric file, keep their distribution.\n\n"
    "Radiance (.rad): polygons, rings, cylinders, cones, cups, tubes, spheres and bubbles with "
    "the\n"
    "diffuse part of their materials, reflecting on both sides and emitting from the front. Round\n"
    "shapes get 24 sides of the circle's area, spheres 16 x 8 faces of the sphere's area. Of\n"
    "commands, !xform with its arrays, !genbox, !genprism and !cat are carried out, with pipes "
    "into\n"
    "xform; a model with others must be expanded by Radiance's own xform first.\n\n"
    "What a model asks for and does not get is told by name. Its files must lie in its folder or\n"
    "below, unless --allow-outside is given."};

struct ImportCommandOptions {
  std::vector<std::string> models;
  std::string output, doors = "closed", luminaires;
  ImportOptions reading;
};

std::string extent_of(const Vec3& e) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g} m", e.x, e.y, e.z);
}

/// A model in another unit than it is taken for is a thousand times too large or too small.
void warn_of_size(const Vec3& extent, Warnings& warnings) {
  const double largest = std::max({extent.x, extent.y, extent.z});
  constexpr double smallest_building_m = 0.5, largest_building_m = 2000.0;
  if (largest >= smallest_building_m && largest <= largest_building_m) return;
  warnings.add(extent_of(extent),
               "unlike a building; where the model is in another unit than metres, "
               "import it with --units, else with --scale");
}

void run_import(const ImportCommandOptions& options, const Console& console) {
  check_scene_output(options.output);
  Warnings warnings;
  ImportOptions reading = options.reading;
  reading.open_doors = options.doors == "open";
  Scene scene = import_model(options.models, reading, warnings);
  LuminaireMatches matches;
  if (!options.luminaires.empty()) matches = match_luminaires(scene, options.luminaires, warnings);
  Box box;
  for (const Surface& surface : scene.surfaces) box.add(bounds(surface.vertices));
  warn_of_size(box.extent(), warnings);
  survey_light(scene, warnings);
  console.warnings(warnings);
  write_scene(scene, options.output);
  const LightSources sources = light_sources(scene);
  const bool lumen = scene.unit == ExitanceUnit::lumen_per_m2;
  TextTable table(options.output);
  table.add("surfaces", with_thousands(scene.surfaces.size()));
  table.add("extent", extent_of(box.extent()));
  table.add("emitting surfaces", with_thousands(sources.surfaces));
  table.add("lights", with_thousands(scene.lights.size()));
  table.add("emitted",
            fmt::format("{:.4g} {}", fmt::join(sources.power, ", "), lumen ? "lm" : "W"));
  table.add("luminous flux", fmt::format("{:.5g} lm", photopic(sources.power, scene.unit)));
  table.add("bands", std::to_string(scene.bands));
  const BuildingData& building = scene.building;
  if (!building.rooms.empty()) table.add("rooms", with_thousands(building.rooms.size()));
  if (!building.portals.empty()) table.add("portals", with_thousands(building.portals.size()));
  if (!building.luminaires.empty())
    table.add("luminaires", with_thousands(building.luminaires.size()));
  if (!options.luminaires.empty()) {
    table.add("photometric files", with_thousands(matches.files));
    table.add("lamps matched", fmt::format("{} of {}", matches.matched, matches.lamps));
  }
  console.print(table.text());
}

void add_options(CLI::App& sub, ImportCommandOptions& o) {
  sub.add_option("model", o.models,
                 "Model to read: .gltf, .glb, .obj, .ifc or .rad; several .rad files are one model")
      ->required();
  sub.add_option("-o,--output", o.output, "Scene file to write (JSON)")->required();
  sub.add_option("--units", o.reading.units,
                 "Unit of the model's lengths: m, cm, mm, ft or in; default: metres, IFC's own")
      ->check(CLI::IsMember({"m", "cm", "mm", "ft", "in"}));
  sub.add_option("--up", o.reading.up,
                 "The model's axis that points up: y or z; default: y, "
                 "z for IFC and Radiance")
      ->check(CLI::IsMember({"y", "z"}));
  sub.add_option("--scale", o.reading.scale, "Factor on all lengths, besides the unit")
      ->check(positive_number())
      ->capture_default_str();
  sub.add_option("--doors", o.doors,
                 "Doors of an IFC model: closed, or open (without their leaves)")
      ->check(CLI::IsMember({"closed", "open"}))
      ->capture_default_str();
  sub.add_option("--luminaires", o.luminaires,
                 "Folder of photometric files (.ies, .ldt), named after the types of lamps");
  sub.add_flag("--allow-outside", o.reading.allow_outside,
               "Read files that the model names outside its own folder");
}

}  // namespace

void add_import(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, import_help, add_options, run_import);
}

}  // namespace enfilade
