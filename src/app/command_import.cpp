// enfilade import: a model of another program becomes a scene file.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/command.hpp"
#include "app/text_table.hpp"
#include "scene/scene_io.hpp"

namespace enfilade {

namespace {

struct ImportOptions {
  std::string model, output;
};

void run_import(const ImportOptions& options, Session& session) {
  Warnings warnings;
  const Scene scene = import_model(options.model, warnings);
  session.console().warnings(warnings);
  write_scene(scene, options.output);
  TextTable table(options.output);
  table.add("surfaces", with_thousands(scene.surfaces.size()));
  table.add("point lights", with_thousands(scene.lights.size()));
  table.add("bands", std::to_string(scene.bands));
  session.console().print(table.text());
}

}  // namespace

void add_import(CLI::App& cli, Command& chosen) {
  auto options = std::make_shared<ImportOptions>();
  CLI::App* sub = cli.add_subcommand("import", "Make a scene file from a glTF, OBJ or IFC model");
  sub->add_option("model", options->model, "Model to read: .gltf, .glb, .obj or .ifc")->required();
  sub->add_option("-o,--output", options->output, "Scene file to write (JSON)")->required();
  sub->footer(
      "Example:\n  enfilade import house.glb -o house.json\n\n"
      "Lengths are taken as metres. Base colour becomes reflectance, emission becomes exitance in\n"
      "W/m2. Materials give three bands: red, green, blue.");
  sub->callback([options, &chosen] {
    chosen = {false, [options](Session& session) { run_import(*options, session); }};
  });
}

}  // namespace enfilade
