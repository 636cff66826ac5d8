// enfilade generate: a building's scene from a short description (§4.2: the paper's modeler).
#include "app/commands/commands.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "base/error.hpp"
#include "building_file/description.hpp"
#include "json/json_text.hpp"
#include "modeler/generate.hpp"
#include "scene_file/scene_stream.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText generate_help{
    "generate", "Make a building's scene from a short description",
    "Examples:\n"
    "  enfilade generate --preset demo -o demo.json\n"
    "  enfilade generate --preset rr3425 --floors 60 -o tower.json\n"
    "  enfilade generate --wings 6,8:60 --floors 2 --furniture lamp=60,desk=20,chair=20 -o l.json\n"
    "  enfilade generate --preset rr3425 --furnace 100 -o furnace.json\n"
    "  enfilade generate building.json --rotate 30 -o scene.json\n\n"
    "A building is a corridor with a room on either side of every bay, storey over storey. Its "
    "wings\n"
    "follow each other; one that turns is an arc, cut into one chord a bay. A description holds "
    "the\n"
    "options' names as keys, with _ for -:\n\n"
    "  {\"format\": \"enfilade-building\", \"version\": 1, \"floors\": 3,\n"
    "   \"wings\": [{\"bays\": 6}, {\"bays\": 8, \"turn\": 60}], \"stairs\": 1,\n"
    "   \"furniture\": {\"lamp\": 60, \"desk\": 20, \"chair\": 20}}\n\n"
    "Furniture is counted by storey, and dealt over the rooms by the seed. Kinds: lamp, desk, "
    "chair,\n"
    "table, shelf, cupboard, bin, plant, monitor, desk_lamp, picture.\n"
    "Presets: demo (a small coloured house), rr3425 (a building of the size of the paper's: "
    "57,786\n"
    "surfaces, 2,000 lights; prepare makes 615 cells and 12,942 clusters of it)."};

struct GenerateOptions {
  std::string description, preset, output;
  std::vector<BuildingOption> changes;
};

Building building_of(const GenerateOptions& options) {
  if (!options.description.empty()) {
    return describe_building(read_text(options.description), options.description, options.changes);
  }
  if (options.preset.empty()) return describe_building("{}", "building", options.changes);
  const auto text = preset_description(options.preset);
  if (!text) {
    throw InputError("command line", "--preset", "there is no preset '" + options.preset + "'",
                     "there are " + preset_names());
  }
  return describe_building(*text, "preset " + options.preset, options.changes);
}

void run_generate(const GenerateOptions& options, const Console& console) {
  check_scene_output(options.output);
  const Building building = building_of(options);
  SceneStream stream(options.output, ExitanceUnit::lumen_per_m2);
  std::vector<Probe> probes;
  const GeneratedCounts counts = generate_building(
      building, [&](const Surface& surface) { stream.add(surface); }, &probes);
  stream.finish({}, probes);
  TextTable table(options.output);
  table.add("floors", std::to_string(building.floors));
  table.add("rooms", with_thousands(counts.rooms));
  table.add("surfaces", with_thousands(counts.surfaces));
  table.add("lights", with_thousands(counts.lights));
  console.print(table.text());
  if (counts.lights == 0) {
    Warnings warnings;
    warnings.add("furniture", "the building is dark; add lamps, such as --furniture lamp=8");
    console.warnings(warnings);
  }
}

void add_change(CLI::App& sub, GenerateOptions& o, const char* key, const std::string& help) {
  std::string name = key;
  std::replace(name.begin(), name.end(), '_', '-');
  sub.add_option_function<std::string>(
         "--" + name, [&o, key](const std::string& value) { o.changes.emplace_back(key, value); },
         help)
      ->group("Building");
}

void add_field(CLI::App& sub, GenerateOptions& o, const DescriptionField& field) {
  const Building defaults;
  std::string help = field.help;
  if (const auto* whole = std::get_if<int Building::*>(&field.member)) {
    help += " (" + std::to_string(defaults.**whole) + ")";
  } else if (const auto* real = std::get_if<double Building::*>(&field.member)) {
    help += " (" + CLI::detail::to_string(defaults.**real) + ")";
  } else {
    help += defaults.*std::get<bool Building::*>(field.member) ? ", true or false (true)"
                                                               : ", true or false (false)";
  }
  add_change(sub, o, field.key, help);
}

void add_options(CLI::App& sub, GenerateOptions& o) {
  auto* file = sub.add_option("description", o.description, "Building to make (JSON)");
  sub.add_option("--preset", o.preset, "Building to make: " + preset_names())->excludes(file);
  sub.add_option("-o,--output", o.output, "Scene file to write (JSON)")->required();
  add_change(sub, o, "wings", "bays of each wing, and the degrees it turns: 24,25:90 (8)");
  add_change(sub, o, "windows", "open, closed (with panes) or none (open)");
  add_change(sub, o, "furniture", "on every storey: chair=300,bin=10");
  add_change(sub, o, "ground_furniture", "on the ground floor beside that");
  for (const DescriptionField& field : building_fields()) add_field(sub, o, field);
}

}  // namespace

void add_generate(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, generate_help, add_options, run_generate);
}

}  // namespace enfilade
