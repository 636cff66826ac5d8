// enfilade prepare: cells, clusters and graphs of a scene, into a RUN directory (§3.2).
#include "app/commands/commands.hpp"
#include "app/commands/prepared_figures.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/plan_files.hpp"
#include "app/outputs/run_outputs.hpp"
#include "import/import_model.hpp"
#include "report/plans/plan_leaks.hpp"
#include "run/leak_file.hpp"
#include "run/prepare.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText prepare_help{
    "prepare", "Cut a scene into cells and clusters: what solve starts from",
    "Example:\n  enfilade prepare scenes/duplex.json -o out/duplex\n\n"
    "solve does this by itself where it has not been done. One rank works, whatever mpirun "
    "starts. Which clusters see each other is found where --hierarchy clusters, export or plan "
    "ask for it."};

struct PrepareOptions {
  std::string scene, run;
  bool pictures = true, allow_outside = false;
  bool prove_hidden = true;
  std::string hierarchy = "building";
};

void run_prepare(const PrepareOptions& options, const Console& console) {
  Warnings warnings;
  const Scene scene = read_scene_or_model(options.scene, warnings, options.allow_outside);
  RunLock lock;
  PrepareConfig config;
  config.visibility.prove_hidden = options.prove_hidden;
  config.cluster_graph = options.hierarchy == "clusters" || !options.prove_hidden;
  const Prepared prepared = prepare(scene, options.run, config, warnings, console.progress(), lock);
  if (!lock.fault().empty()) warnings.add(options.run + "/lock", lock.fault());
  remove_run_outputs(options.run);  // of the solution that was dropped
  console.warnings(warnings);
  if (options.pictures) {
    const Occluders occluders(prepared.clusters);
    const PlannedBuilding building{prepared.cells, prepared.clusters, occluders};
    const std::vector<Leak> leaks = read_leaks(options.run);
    const std::vector<Storey> all = storeys(building);
    std::vector<FloorPlan> plans = floor_plans(building, cells_subject(building));
    for (FloorPlan& plan : plans) draw_leaks(plan, all, leaks);
    write_run_plans(options.run, plans);
  }
  TextTable table(options.run);
  table.add("surfaces", with_thousands(prepared.scene.surfaces.size()));
  table.add("cells", with_thousands(prepared.cells.open_cells()));
  table.add("portals", with_thousands(prepared.cells.portals().size()));
  table.add("clusters", with_thousands(prepared.clusters.size()));
  if (prepared.has_visibility) table.add("visible pairs", with_thousands(prepared.graph.edges()));
  add_prepare_cost(table, prepared);
  console.print(table.text());
}

void add_options(CLI::App& sub, PrepareOptions& o) {
  sub.add_option("scene", o.scene, "Scene file (JSON, or a model that import takes)")->required();
  sub.add_option("-o,--output", o.run, "RUN directory to fill; a solution in it is dropped")
      ->required();
  sub.add_option("--hierarchy", o.hierarchy,
                 "building: for solve's default; clusters: find all pairs of clusters that may see "
                 "each other, too (G_cluster), for 'solve RUN --hierarchy clusters'")
      ->check(CLI::IsMember({"building", "clusters"}));
  sub.add_flag("!--no-proof", o.prove_hidden,
               "Find the pairs of clusters, and keep those that could be proved hidden by what "
               "stands between: several times as fast, up to twice the pairs");
  sub.add_flag("--allow-outside", o.allow_outside,
               "Read photometric files that the scene names outside its own folder");
  sub.add_flag("!--no-pictures", o.pictures, "Draw no plans of the storeys into RUN/pictures");
}

}  // namespace

void add_prepare(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, prepare_help, add_options, run_prepare);
}

}  // namespace enfilade
