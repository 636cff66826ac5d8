// enfilade import: a model of another program becomes a scene file.
#include "app/commands/commands.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "import/import_model.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText help_text{
    "import", "Make a scene file from a glTF, OBJ, IFC or Radiance model",
    "Example:\n  enfilade import house.glb -o house.json\n\n"
    "  enfilade import office.rad -o office.json\n\n"
    "Lengths are taken as metres. Base colour becomes reflectance, emission becomes exitance:\n"
    "lm/m2 where the model has luminances (glTF, OBJ, IFC), W/m2 of a Radiance model's "
    "radiances.\n"
    "Materials give three bands: red, green, blue.\n\n"
    "Radiance (.rad): polygons, rings, cylinders, cones, cups, tubes, spheres and bubbles with "
    "the\n"
    "diffuse part of their materials, reflecting on both sides and emitting from the front. "
    "Round\n"
    "shapes get 24 sides of the circle's area, spheres 16 x 8 faces of the sphere's area. Of\n"
    "commands, plain !xform lines are carried out (-n -t -rx -ry -rz -s -mx -my -mz); a model "
    "with\n"
    "others must be expanded by Radiance's own xform first."};

struct ImportOptions {
  std::string model, output;
};

void run_import(const ImportOptions& options, const Console& console) {
  check_scene_output(options.output);
  Warnings warnings;
  const Scene scene = import_model(options.model, warnings);
  console.warnings(warnings);
  write_scene(scene, options.output);
  TextTable table(options.output);
  table.add("surfaces", with_thousands(scene.surfaces.size()));
  table.add("point lights", with_thousands(scene.lights.size()));
  table.add("bands", std::to_string(scene.bands));
  console.print(table.text());
}

void add_options(CLI::App& sub, ImportOptions& o) {
  sub.add_option("model", o.model, "Model to read: .gltf, .glb, .obj, .ifc or .rad")->required();
  sub.add_option("-o,--output", o.output, "Scene file to write (JSON)")->required();
}

}  // namespace

void add_import(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, help_text, add_options, run_import);
}

}  // namespace enfilade
