#include "app/solve/solve_options.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "app/frame/option_checks.hpp"
#include "app/frame/subcommand.hpp"
#include "base/error.hpp"
#include "machine/cost_model.hpp"

namespace enfilade {

const char* const solve_footer =
    "Examples:\n"
    "  enfilade solve scenes/duplex.json -o out/duplex\n"
    "  mpirun -n 4 enfilade solve scenes/duplex.json -o out/duplex --target-error 0.01\n"
    "  enfilade solve out/duplex --resume            (after a crash)\n"
    "  smpirun -platform platforms/office.xml -hostfile platforms/office-4.hosts -np 4 \\\n"
    "    enfilade-smpi solve scenes/duplex.json -o out/simulated\n"
    "  smpirun -platform platforms/office.xml -hostfile platforms/office-2.hosts -np 2 \\\n"
    "    enfilade-smpi solve --replay out/simulated -o out/two-hosts\n\n"
    "The RUN directory then holds stats.json, surfaces.csv, solution.glb, pictures, report.html, "
    "walk.html\n"
    "(the building to walk through in a browser), and probes.json where the scene has probes.";

namespace {

namespace fs = std::filesystem;

/// Options that the light depends on, or where it is written; a replay computes no light and
/// refuses them. The other options concern how the work is distributed.
constexpr std::array of_the_light = {
    "--target-error", "--epsilon",        "--tolerance", "--basis",
    "--oracle",       "--visibility",     "--iteration", "--no-coarse-correction",
    "--local-dir",    "--max-iterations", "--scheme",    "--no-pictures",
    "--resume",       "--patch-links",    "--hierarchy", "--target-error-at",
    "--rooms",        "--shares",         "--relight",   "--no-walk"};

/// Below this share of the light, what is asked for drowns in the rounding of numbers.
constexpr double least_share = 1e-9;

Basis basis_of(const std::string& name) {
  return name == "constant" ? Basis::constant : Basis::linear;
}

/// Does not throw, unlike fs::is_directory without an error code, where access is denied.
bool is_directory(const std::string& path) {
  std::error_code code;
  return fs::is_directory(path, code);
}

std::vector<std::string> texts(std::span<const char* const> names) {
  return {names.begin(), names.end()};
}

/// Accepts the name that an option's value had before, and notes what its name is now.
CLI::Validator renamed_value(const char* option, const char* before, const char* now,
                             std::vector<std::string>& notes) {
  return CLI::Validator(
      [=, &notes](std::string& value) -> std::string {
        if (value != before) return "";
        value = now;
        notes = {std::string(option) + " " + before + " is called " + now + " now"};
        return "";
      },
      "");
}

void add_accuracy_options(CLI::App& sub, SolveOptions& o) {
  OptionGroup group(sub, "How good");
  group.add("--target-error", o.target_error,
            "Error to reach: relative, area-weighted L1 of the irradiance (0.02 = 2%)",
            number_between(least_share, 1.0));
  group.add(
      "--target-error-at", o.target_error_at,
      "Hold the target error at the points of this probe file alone, for light gathered for "
      "(probe): links are fine where the light on its way there needs it, and rough elsewhere. To "
      "go on with --resume, give it again");
  group.add("--patch-links", o.patch_links,
            "Hold what is read off patches (surfaces.csv, pictures, model) to the target error as "
            "well, until there are more links than this; past it only light gathered for (probe) "
            "is. 0: whatever it takes; default: 200000, fewer where more than 2% is asked");
  group
      .add("--epsilon", o.epsilon,
           "Refine links whose error is above this share of the emitted power; default: what the "
           "target error asks for")
      ->check(number_between(least_share, 1.0));
  group
      .add("--tolerance", o.tolerance,
           "Stop iterating below this relative change of the light; default: what the target "
           "error asks for")
      ->check(number_between(least_share, 1.0));
  group.add("--basis", o.basis, "Light over a patch: constant or linear; auto means linear",
            CLI::IsMember({"constant", "linear", "auto"}));
  group.add("--oracle", o.oracle,
            "What refines a link: error (what may be wrong with it) or bf (the power that it "
            "carries, after Hanrahan 91)",
            CLI::IsMember({"error", "bf"}));
  group.add("--visibility", o.visibility,
            "How links are tested: exact (cut against the few polygons between) or rays alone",
            CLI::IsMember({"exact", "rays"}));
  group.add(
      "--hierarchy", o.hierarchy,
      "Where links start: building (far rooms and groups of things shoot as one, visibility "
      "is asked where light is at stake) or clusters (one link or more for each pair of "
      "clusters that may see each other, as in the paper, and with the schemes other than spmd)",
      CLI::IsMember({"building", "clusters"}));
  group.add("--max-iterations", o.max_iterations, "Give up after so many iterations",
            CLI::Range(1, 1000000));
}

void add_method_options(OptionGroup& group, SolveOptions& o) {
  group.add("--scheme", o.scheme,
            "How ranks share the work: spmd, each with files of its own, stealing; master-slave, "
            "groups by messages from rank 0 (after Funkhouser 96); replicated, one cell after the "
            "other on all ranks (after Feng and Yang 97)",
            CLI::IsMember(texts(scheme_names())));
  group.add("--assignment", o.assignment,
            "Clusters to ranks (spmd): kmeans (figure 1), metis, greedy (grown by estimated form "
            "factors, after Funkhouser 96) or round-robin",
            CLI::IsMember(texts(assignment_names())));
  group.add("--order", o.order,
            "Order in which a rank's clusters gather: travelling-salesman, greedy, random, input "
            "(as numbered; the default of one rank that may keep all clusters in memory), "
            "backtracking (depth first), unshot-energy (where most light waits)",
            CLI::IsMember(texts(order_names())));
  group.flag("--no-steal", o.no_steal,
             "A rank that is out of work waits, and takes none from the others");
  group.flag("--no-coarse-correction", o.no_correction,
             "The paper's group iteration as it is, which needs more iterations at many ranks");
  group
      .add("--iteration", o.iteration,
           "Light that a gather takes from its own rank's clusters: jacobi, the last iteration's; "
           "hybrid, the newest (Gauss-Seidel within a rank) with --no-coarse-correction, else "
           "the last iteration's as well",
           CLI::IsMember({"hybrid", "jacobi"}))
      ->transform(renamed_value("--iteration", "gauss-seidel", "hybrid", o.notes));
}

void add_resource_options(OptionGroup& group, SolveOptions& o) {
  group.add("--memory", o.memory,
            "Memory a rank may use for clusters, as 512M or 2G; the rest stays on disk. "
            "Default: no limit");
  group.add("--memory-manager", o.memory_manager,
            "own: the solver places clusters in the memory itself and gives back what is free; "
            "malloc: leave that to a general-purpose heap. stats.json tells the heap's extent "
            "and what of it would be swapped, where --memory is given",
            CLI::IsMember({"own", "malloc"}));
  group.add("--local-dir", o.local_directory,
            "Where each rank makes its local directory; default: RUN/local");
  group.add("--cost-model", o.cost_model,
            "What counted work costs on a simulated host (JSON); default: the built-in model");
  group.add("--replay", o.replay,
            "On a simulated cluster: do what RUN recorded in place of the kernels, for the "
            "time alone; a what-if takes seconds");
  group.add("--seed", o.seed, "Seed of everything that draws lots", whole_number());
}

}  // namespace

std::string SolveOptions::scene_file() const {
  if (!is_directory(input)) return input;
  return run_directory() == input ? "" : (fs::path(input) / "scene.json").string();
}

std::string SolveOptions::run_directory() const {
  if (output.empty()) return input;
  std::error_code missing;
  return fs::equivalent(input, output, missing) ? input : output;
}

void SolveOptions::check_replay() const {
  for (const char* option : of_the_light) {
    if (!gave(option)) continue;
    throw InputError("command line", option,
                     "does not go with --replay, which does the recorded run once more",
                     "leave one of them out");
  }
  std::error_code missing;
  if (fs::equivalent(replay, output, missing)) {
    throw InputError("command line", "-o", "is the run that is replayed", "name another directory");
  }
}

void SolveOptions::check_relight() const {
  if (!is_directory(input)) {
    throw InputError("command line", "--relight", "needs the links of a solved RUN",
                     "name the RUN first, as in enfilade solve out/run --relight new.json");
  }
  for (const char* option : {"--resume", "--basis", "--epsilon", "--hierarchy"}) {
    if (!gave(option)) continue;
    throw InputError("command line", option,
                     "does not go with --relight, which takes the links as they are",
                     "leave one of them out");
  }
}

bool SolveOptions::gave(const std::string& option) const {
  return std::find(given.begin(), given.end(), option) != given.end();
}

bool SolveOptions::basis_is_given() const { return gave("--basis") && basis != "auto"; }

void SolveOptions::check_scheme() const {
  const auto refuse = [this](const char* option, const char* why) {
    if (!gave(option)) return;
    throw InputError("command line", option, "does not go with --scheme " + scheme + why,
                     "leave one of them out");
  };
  if (scheme == "spmd") return;
  refuse("--assignment", ": its master deals the clusters out");
  if (scheme == "replicated") refuse("--order", ": it goes from cell to cell by unshot energy");
  if (order == "unshot-energy") refuse("--order", ": it needs one rank that sees every gather");
}

SolveConfig SolveOptions::config() const {
  if (input.empty() == replay.empty()) {
    throw InputError("command line", "solve", "takes either a scene or --replay RUN",
                     "name one of them; see 'enfilade solve --help'");
  }
  if (!replay.empty()) check_replay();
  check_scheme();
  if (!relight.empty()) check_relight();
  if (output.empty() && !is_directory(input)) {
    if (std::error_code code; !input.empty() && !fs::exists(input, code)) {
      throw InputError(input, "file", code ? code.message() : "does not exist", "check the path");
    }
    throw InputError("command line", "solve", "-o is missing",
                     "name the RUN directory to fill, as in -o out/run");
  }
  SolveConfig config;
  config.run_directory = run_directory();
  config.local_directory = local_directory;
  config.gather.basis = basis_of(basis);
  config.target_error = target_error;
  config.epsilon = epsilon;
  config.tolerance = tolerance;
  config.patch_links = patch_links;
  if (!memory.empty()) config.memory_bytes = parse_bytes(memory, "command line", "--memory");
  config.memory_manager = enfilade::memory_manager(memory_manager);
  config.seed = seed;
  config.scheme = scheme_of(scheme);
  config.assignment = assignment_method(assignment);
  config.order = tour_order(order);
  config.method.jacobi = iteration == "jacobi";
  config.steal = !no_steal;
  config.hierarchy = hierarchy == "clusters" ? Hierarchy::clusters : Hierarchy::building;
  config.method.coarse_correction = !no_correction;
  config.resume = resume;
  config.max_iterations = max_iterations;
  if (oracle == "bf") config.gather.oracle = OracleKind::brightness_form_factor;
  if (visibility == "rays") config.gather.visibility = VisibilityMethod::rays;
  return config;
}

void add_solve_options(CLI::App& sub, SolveOptions& o) {
  sub.add_option("input", o.input, "Scene file, or a RUN directory that prepare or solve has made");
  sub.add_option("-o,--output", o.output,
                 "RUN directory to fill; may be left out where the input is one");
  add_accuracy_options(sub, o);
  OptionGroup parallel(sub, "How the work is cut up and ordered");
  add_method_options(parallel, o);
  add_resource_options(parallel, o);
  sub.add_flag("--resume", o.resume, "Go on from the last committed iteration");
  sub.add_option(
      "--relight", o.relight,
      "Scene of the same geometry as that of the RUN given, with other lamps or "
      "reflectances: its light over the RUN's links, in a fraction of the time. Into the "
      "RUN itself, or into -o. The error is estimated anew");
  sub.add_flag("--allow-outside", o.allow_outside,
               "Read photometric files that the scene names outside its own folder");
  sub.add_flag("--trace", o.trace,
               "Keep what each rank does when: RUN/trace.paje, pictures/ranks.svg and .png");
  sub.add_flag("!--no-pictures", o.pictures, "Make no PNG pictures, and no walk.html");
  sub.add_flag("!--no-walk", o.walk,
               "Make no walk.html, the building to walk through in a browser");
  sub.add_flag(
      "--rooms", o.rooms,
      "Also the light in each room: RUN/rooms.csv, and first in report.html; 'enfilade rooms' "
      "and 'enfilade report' find it later as well");
  sub.add_flag(
      "--shares", o.shares,
      "Also the share of each luminaire, over the same links: RUN/shares, for 'probe "
      "--shares' and '--switch'. Lights of one \"switch\" are one share; without it, lights "
      "of one name, and emitting surfaces of one object or name. With --resume, of a run "
      "that is solved");
  sub.add_flag("--quiet", o.quiet, "No summary at the end");
  sub.parse_complete_callback([&sub, &o] {
    o.given.clear();
    for (const CLI::Option* option : sub.get_options()) {
      if (option->count() > 0) o.given.push_back(option->get_name());
    }
  });
}

}  // namespace enfilade
