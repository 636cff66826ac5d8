// enfilade probe: irradiance at asked points, by one gather from the solution or read off its
// patches.
#include "app/commands/commands.hpp"
#include "app/frame/option_checks.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/daylight_factor.hpp"
#include "app/outputs/solved_run.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText probe_help{
    "probe", "Say how much light arrives at points",
    "Example:\n  enfilade probe out/duplex --points desks.json -o desks_lux.json\n\n"
    "desks.json is {\"probes\": [{\"p\": [x,y,z], \"n\": [0,0,1]}, ...]}, in metres. E is the "
    "irradiance\n"
    "on a plane through p with normal n, per band, in the unit that the answer names; error is\n"
    "one standard deviation of it: noise of the rays, and the estimated error of the solution.\n\n"
    "desks.csv will do as well: x,y,z or x,y,z,nx,ny,nz on each line, in metres, with or without "
    "a\n"
    "header; without normals they point up, and further columns are kept. An answer that ends in "
    ".csv\n"
    "has E and error as further columns (E_0, E_1, ... of several bands)."};

struct ProbeOptions {
  std::string run, points, output, from = "gather";
  bool daylight_factor = false;
  PointGatherConfig gather;
  RunLight light;
};

void run_probe(const ProbeOptions& options, const Console& console) {
  check_output_file(options.output);
  const ProbeFile points = read_probes(options.points);
  const std::vector<Probe>& probes = points.probes;
  RunLock lock;
  lock.read(options.run);
  const SolvedRun run(options.run, options.gather, options.light);
  ProbeAnswers found = irradiance_at(run, probes, probe_method(options.from), console.progress());
  if (options.daylight_factor)
    add_daylight_factors(options.run, run.prepared().scene, found.answers);
  write_probe_answers(points, options.output, found.answers, options.from,
                      run.prepared().scene.unit);
  TextTable table(options.output);
  table.add("points", with_thousands(probes.size()));
  table.add("unit", irradiance_label(run.prepared().scene.unit));
  if (options.light.shares) table.add("shares", with_thousands(run.shares().size()));
  if (found.in_the_open > 0)
    table.add("see nothing", with_thousands(found.in_the_open) + ": no surface faces them");
  if (found.behind > 0) {
    table.add("lie behind", with_thousands(found.behind) +
                                ": most of what they see is backs, as in a wall or under a floor");
  }
  console.print(table.text());
}

void add_options(CLI::App& sub, ProbeOptions& o) {
  sub.add_option("run", o.run, "RUN directory that solve has filled")->required();
  sub.add_option("--points", o.points, "Probe file (.json or .csv)")->required();
  sub.add_option("-o,--output", o.output,
                 "File to write, .json or .csv: the same with E and error at each probe")
      ->required();
  sub.add_option(
         "--from", o.from,
         "gather: once more from all that the point sees; patches: read off the surface below it")
      ->check(CLI::IsMember({"gather", "patches"}))
      ->capture_default_str();
  sub.add_flag("--daylight-factor", o.daylight_factor,
               "Add the daylight factor, percent: E over that of an unobstructed horizontal plane "
               "under the scene's sky; for scenes without lamps and without sunlight");
  add_switch_option(sub, o.light.switches);
  sub.add_flag("--shares", o.light.shares,
               "Also the light by each luminaire or switch, as \"shares\": they sum to E")
      ->excludes("--switch");
  sub.add_option("--rays", o.gather.rays,
                 "Rays over the hemisphere that tell what a point sees (default: by the estimated "
                 "error of the patches, from 4096 for 1% down to 512 for 3%)")
      ->check(CLI::Range(4, 100000000));
  sub.add_option("--noise", o.gather.noise,
                 "More rays, up to 16 times as many, where their noise is above this share of a "
                 "point's light and 2e-5 of the mean irradiance (0: never; default: half of the "
                 "estimated error of the patches, at most 0.005)")
      ->check(share_of_one());
  sub.add_option("--seed", o.gather.seed, "Seed of the rays")
      ->check(whole_number())
      ->capture_default_str();
}

}  // namespace

void add_probe(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, probe_help, add_options, run_probe);
}

}  // namespace enfilade
