// enfilade bounds: intervals that hold the mean irradiance of rooms and surfaces for certain.
#include <fmt/format.h>

#include "app/commands/commands.hpp"
#include "app/frame/option_checks.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/run_bounds.hpp"
#include "base/atomic_file.hpp"
#include "base/usable_cores.hpp"
#include "run/solution.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText bounds_help{
    "bounds", "Say between which limits the light of rooms and surfaces lies for certain",
    "Example:\n  enfilade bounds out/house -o bounds.csv --bounds 0.05\n\n"
    "One line for the scene, each room and each surface: kind, name, then lower and upper limits "
    "of the\nmean irradiance per band, and the run's estimate of it. A room is a cell of the "
    "scene; "
    "its mean is\nthe area-weighted mean over all surfaces, or parts of them, that face into the "
    "cell. A room has\nthe name that the scene file gives it (\"rooms\").\n\n"
    "The limits are proved and owe nothing to the run's solution: form factors and visibility are "
    "bounded from\nboth sides, for all points of a patch, and the light is iterated between both. "
    "They hold\n"
    "- for the scene as it was prepared: planar one-sided polygons that reflect and emit "
    "diffusely;\n"
    "- where gaps and offsets below 1e-7 of the scene's extent count as closed;\n"
    "- but for rounding (relative 1e-9 is added).\n"
    "More links never make a limit worse. What cannot be decided within them is left open, so that "
    "in a large\nbuilding the limits are wide."};

struct BoundsOptions {
  std::string run, output;
  BoundConfig config{.most_links = 1'000'000, .most_seconds = 120.0, .threads = 0};
};

std::string reason(BoundStop stop) {
  switch (stop) {
    case BoundStop::reached:
      return "all rooms are narrow enough";
    case BoundStop::links:
      return "links used up (--links)";
    case BoundStop::seconds:
      return "time used up (--seconds)";
    case BoundStop::finest:
      break;
  }
  return "finer links do not narrow them";
}

void run_bounds(const BoundsOptions& options, const Console& console) {
  check_output_file(options.output);
  RunLock lock;
  lock.read(options.run);
  const Prepared prepared = load_prepared(options.run);
  const std::vector<ClusterState> solution = read_solution(options.run);
  const BoundedRun run = bounded_run(prepared);
  BoundConfig config = options.config;
  if (config.threads == 0) config.threads = usable_cores();
  const BoundResult found = bound_irradiance(run.scene, config, console.progress());
  console.end_progress();
  write_file_atomically(options.output, bounds_csv(prepared, run, found, solution));
  TextTable table(options.output);
  table.add("rooms", with_thousands(run.cells.size()));
  table.add("widest", fmt::format("{:.3g}% of its middle", 100.0 * widest(found.targets)));
  table.add("stopped", reason(found.stop));
  table.add("links", with_thousands(found.links));
  table.add("patches", with_thousands(found.patches));
  table.add("see fronts alone",
            fmt::format("{} of {} polygons", with_thousands(found.closed_polygons),
                        with_thousands(run.scene.polygons.size())));
  console.print(table.text());
}

void add_options(CLI::App& sub, BoundsOptions& o) {
  sub.add_option("run", o.run, "RUN directory that solve has filled")->required();
  sub.add_option("-o,--output", o.output, "File to write (CSV)")->required();
  sub.add_option("--bounds", o.config.relative_width,
                 "Wanted: no room's interval wider than this share of its middle")
      ->check(positive_number())
      ->capture_default_str();
  sub.add_option("--links", o.config.most_links, "Links between patches, at most about so many")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}))
      ->capture_default_str();
  sub.add_option("--seconds", o.config.most_seconds,
                 "Begin no further refinement after so long (0: never end by time)")
      ->check(number_from_zero())
      ->capture_default_str();
  sub.add_option("--threads", o.config.threads, "Threads (0: one for each usable core)")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

}  // namespace

void add_bounds(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, bounds_help, add_options, run_bounds);
}

}  // namespace enfilade
