// enfilade export: a RUN's solution as a glTF model, or its graph as JSON.
#include <filesystem>

#include "app/commands/commands.hpp"
#include "app/commands/graph_file.hpp"
#include "app/frame/option_checks.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/solved_run.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "report/export/solution_glb.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText export_help{
    "export", "Write the light as a glTF model, or the visibility graph as JSON",
    "Examples:\n  enfilade export out/duplex -o duplex.glb     (vertex colours, unlit: any "
    "viewer)\n"
    "  enfilade export out/duplex -o graph.json     (clusters, their cell and surfaces, visible "
    "pairs)"};

struct ExportOptions {
  std::string run, output;
  RunLight light;
};

Prepared with_visibility(const std::string& run, const Progress& progress) {
  Prepared prepared = load_prepared(run);
  find_visibility(prepared, {}, progress);
  return prepared;
}

void run_export(const ExportOptions& options, const Console& console) {
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension != ".glb" && extension != ".json") {
    throw InputError("command line", "export",
                     "'" + options.output + "' is of no kind that can be exported",
                     "name a .glb file for the light or a .json file for the graph");
  }
  check_output_file(options.output);
  RunLock lock;
  lock.read(options.run);
  const std::string content =
      extension == ".json" ? graph_json(with_visibility(options.run, console.progress()))
                           : solution_glb(SolvedRun(options.run, {}, options.light).solved_scene());
  write_file_atomically(options.output, content);
  TextTable table(options.output);
  table.add("size", format_bytes(static_cast<double>(content.size())));
  console.print(table.text());
}

void add_options(CLI::App& sub, ExportOptions& o) {
  sub.add_option("run", o.run, "RUN directory: solved for .glb, prepared for .json")->required();
  sub.add_option("-o,--output", o.output, "File to write; its ending says what: .glb or .json")
      ->required();
  add_switch_option(sub, o.light.switches);
}

}  // namespace

void add_export(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, export_help, add_options, run_export);
}

}  // namespace enfilade
