// enfilade export: a RUN's solution as a model to look at, or its graph as data.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/command.hpp"
#include "app/graph_file.hpp"
#include "app/output_file.hpp"
#include "app/solved_run.hpp"
#include "app/text_table.hpp"
#include "base/error.hpp"
#include "report/export/solution_glb.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {

namespace {

struct ExportOptions {
  std::string run, output;
};

void run_export(const ExportOptions& options, Session& session) {
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension != ".glb" && extension != ".json") {
    throw InputError("command line", "export",
                     "'" + options.output + "' is of no kind that can be exported",
                     "name a .glb file for the light or a .json file for the graph");
  }
  check_output_file(options.output);
  const std::string content = extension == ".json"
                                  ? graph_json(load_prepared(options.run))
                                  : solution_glb(SolvedRun(options.run).solved_scene());
  write_file_atomically(options.output, content);
  TextTable table(options.output);
  table.add("size", format_bytes(static_cast<double>(content.size())));
  session.console().print(table.text());
}

}  // namespace

void add_export(CLI::App& cli, Command& chosen) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* sub = cli.add_subcommand(
      "export", "Write the light as a glTF model, or the visibility graph as JSON");
  sub->add_option("run", options->run, "RUN directory: solved for .glb, prepared for .json")
      ->required();
  sub->add_option("-o,--output", options->output,
                  "File to write; its ending says what: .glb or .json")
      ->required();
  sub->footer(
      "Examples:\n  enfilade export out/duplex -o duplex.glb     (vertex colours, unlit: any "
      "viewer)\n"
      "  enfilade export out/duplex -o graph.json     (clusters, their cell and surfaces, visible "
      "pairs)");
  sub->callback([options, &chosen] {
    chosen = {false, [options](Session& session) { run_export(*options, session); }};
  });
}

}  // namespace enfilade
