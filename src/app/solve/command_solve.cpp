// enfilade solve: the light, on all ranks; then the files for people, on rank 0.
#include "app/solve/command_solve.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "app/frame/solve_name.hpp"
#include "app/outputs/run_outputs.hpp"
#include "app/outputs/target_points.hpp"
#include "app/solve/relight_run.hpp"
#include "app/solve/run_choices.hpp"
#include "app/solve/run_description.hpp"
#include "app/solve/solve_options.hpp"
#include "app/solve/solve_summary.hpp"
#include "base/atomic_file.hpp"
#include "base/byte_stream.hpp"
#include "base/error.hpp"
#include "base/posix_file.hpp"
#include "import/import_model.hpp"
#include "report/page/rank_timeline.hpp"
#include "run/history.hpp"
#include "run/prepare.hpp"
#include "run/run_mark.hpp"
#include "run/stats_json.hpp"
#include "scene_file/scene_io.hpp"
#include "schemes/protocol/prepare_on_root.hpp"
#include "schemes/protocol/rank_profiles.hpp"
#include "schemes/replay/replay.hpp"
#include "schemes/shares/solve_shares.hpp"
#include "schemes/solve/solve.hpp"

namespace enfilade {

namespace {

/// Returns rank 0's points on every rank. All ranks call it.
std::vector<Probe> points_of_root(const std::vector<Probe>& points, Communicator& communicator) {
  std::vector<Vec3> places;
  for (const Probe& point : points) places.insert(places.end(), {point.p, point.n});
  ByteWriter own;
  own.put_all(places);
  const std::string bytes = communicator.broadcast(own.text());
  places = ByteReader(std::string_view(bytes), "points").get_all<Vec3>();
  std::vector<Probe> received;
  for (std::size_t i = 0; i + 1 < places.size(); i += 2)
    received.push_back({places[i], places[i + 1]});
  return received;
}

/// Checks the options on the root first, so that a fault is printed once and all ranks end in
/// order.
SolveConfig agree_on_config(const SolveOptions& options, RankSession& session) {
  std::vector<Probe> points;
  session.communicator().on_root([&] {
    options.config();
    if (!options.target_error_at.empty()) points = read_probes(options.target_error_at).probes;
  });
  SolveConfig config = options.config();
  // One rank with room for all clusters: no order loads less than another, and the iterations are
  // Jacobi's, which give the same light in any order (with the coarse correction all but those
  // after a correction that failed).
  if (!options.order_is_given() && session.communicator().size() == 1 && options.replay.empty() &&
      config.memory_bytes == 0 && session.machine(options.cost_model).memory_bytes() == 0 &&
      (config.method.coarse_correction || config.method.jacobi))
    config.order = TourOrder::input;
  if (!options.target_error_at.empty())
    config.gather.target_points = points_of_root(points, session.communicator());
  return config;
}

/// All ranks call it; rank 0 writes.
void write_trace(const std::string& run_directory, Communicator& communicator,
                 const Machine& machine) {
  const std::vector<RankProfile> ranks = gather_profiles(communicator, machine);
  if (!communicator.root()) return;
  const Drawing timeline = rank_timeline(ranks);
  make_directory(run_directory + "/pictures");
  write_file_atomically(run_directory + "/trace.paje", paje_trace(ranks));
  write_file_atomically(run_directory + "/pictures/ranks.svg", to_svg(timeline));
  write_file_atomically(run_directory + "/pictures/ranks.png",
                        encode_png(to_bitmap(timeline), timeline.title));
}

void check_local_directory(const std::string& directory) {
  std::error_code code;
  std::filesystem::create_directories(directory, code);
  if (!code && ::access(directory.c_str(), R_OK | W_OK | X_OK) == 0) return;
  throw InputError(
      "command line", "--local-dir",
      directory + " cannot be made and written: " + (code ? code.message() : std::strerror(errno)),
      "name a directory that can");
}

/// Empty for a RUN directory that is solved in place.
SceneSource source_of(const std::string& scene_file, bool allow_outside) {
  if (scene_file.empty()) return {};
  return [scene_file, allow_outside](Warnings& warnings) {
    return read_scene_or_model(scene_file, warnings, allow_outside);
  };
}

RunOutputs outputs_of(const SolveOptions& options, const SolveConfig& config) {
  return {config.run_directory, options.pictures, options.rooms, options.pictures && options.walk};
}

/// True where a finished run is asked to go on and no iteration is left, nor a file to write: RUN
/// stays as it is, and is told once more.
bool nothing_is_left(const SolveOptions& options, const SolveConfig& config,
                     const Prepared& prepared, RankSession& session) {
  if (options.trace || !is_solved(config, prepared, session.communicator())) return false;
  std::string whole;
  session.communicator().on_root([&] {
    if (!has_run_outputs(outputs_of(options, config), prepared.scene)) return;
    whole = "whole";
    const RunRecord stats = read_stats(config.run_directory);
    session.console().warnings(shortfall_of(config.run_directory, stats, config.max_iterations));
    session.console().note(config.run_directory + " is solved, and left as it is");
    if (!options.quiet) session.console().print(solve_summary(config.run_directory, stats));
  });
  return !session.communicator().broadcast(whole).empty();
}

/// Finds the shares of a solution. All ranks call it; the index is rank 0's.
ShareIndex find_shares(const SolveConfig& config, Prepared& prepared, Machine& machine,
                       RankSession& session) {
  ShareIndex index =
      solve_shares(config, prepared, session.communicator(), machine, session.console().progress());
  if (session.communicator().root()) {
    Warnings warnings = shares_shortfall(config.run_directory, index);
    session.console().warnings(warnings);
  }
  return index;
}

/// True on all ranks where a run that is left as it is lacks the shares that are asked for, or has
/// them damaged.
bool shares_are_missing(const SolveOptions& options, const SolveConfig& config,
                        const Prepared& prepared, RankSession& session) {
  if (!options.shares) return false;
  std::string missing;
  session.communicator().on_root([&] {
    if (!has_whole_shares(config.run_directory, prepared.clusters.size())) missing = "missing";
  });
  return !session.communicator().broadcast(missing).empty();
}

/// Finds the shares of a run that is left as it is, and makes its page anew with them.
void add_shares(const SolveOptions& options, const SolveConfig& config, Prepared& prepared,
                Machine& machine, RankSession& session) {
  const ShareIndex shares = find_shares(config, prepared, machine, session);
  session.communicator().on_root([&] {
    const SolvedRun run(std::move(prepared), config.run_directory);
    RunRooms rooms(run);
    write_walk_page(outputs_of(options, config), run, rooms, nullptr);
    if (!options.quiet) session.console().print(shares_summary(config.run_directory, shares));
  });
}

/// The scene, prepared; with --relight, prepared as the run whose links are taken, which `config`
/// then names.
Prepared prepare_run(const SolveOptions& options, SolveConfig& config, RankSession& session,
                     Warnings& warnings, RunLock& lock) {
  const Progress& progress = session.console().progress();
  report_progress(progress, "reading the scene", 0.0);
  if (!options.relight.empty())
    return begin_relight(options, config, session.communicator(), warnings, lock);
  PrepareConfig prepare_config;  // proofs of hidden pairs pay where a solve makes millions of links
  prepare_config.visibility.prove_hidden = false;
  prepare_config.cluster_graph = config.topmost() == Hierarchy::clusters;
  return prepare_on_root(
      session.communicator(), source_of(options.scene_file(), options.allow_outside),
      config.run_directory, prepare_config, warnings, progress, config.resume, lock);
}

void run_solve(const SolveOptions& options, RankSession& session) {
  const Console& console = session.console();
  Communicator& communicator = session.communicator();
  SolveConfig config = agree_on_config(options, session);
  Machine& machine = session.machine(options.cost_model);

  Warnings warnings;
  RunLock lock;
  Prepared prepared = prepare_run(options, config, session, warnings, lock);
  if (!lock.fault().empty()) warnings.add(config.run_directory + "/lock", lock.fault());
  communicator.on_root([&] {
    const Warnings blind =
        blind_target_points(options.target_error_at, config.gather.target_points, prepared);
    for (const Warning& w : blind.all()) warnings.add(w.where, w.what);
  });
  console.warnings(warnings);
  if (nothing_is_left(options, config, prepared, session)) {
    if (shares_are_missing(options, config, prepared, session))
      add_shares(options, config, prepared, machine, session);
    return;
  }

  communicator.on_root([&] {
    // The root reads first what every rank is about to read, so that a fault is reported once.
    if (config.resume) committed_iterations(config.run_directory);
    if (!config.local_directory.empty()) check_local_directory(config.local_directory);
    if (options.shares) share_groups(prepared.scene);
    remove_run_outputs(config.run_directory);
  });
  if (options.trace) machine.trace();
  SolveProgress progress(config.target_error, console.progress());
  report_progress(console.progress(), "solve: first iteration,", 0.0);
  RunRecord stats = solve(config, prepared, communicator, machine, progress.observer());
  describe_run(stats, config, prepared);
  describe_choices(stats, options.basis_is_given());
  if (options.trace) write_trace(config.run_directory, communicator, machine);
  std::optional<ShareIndex> shares;
  if (options.shares) {
    shares = find_shares(config, prepared, machine, session);
    describe_shares(stats, *shares);
  }

  communicator.on_root([&] {
    const std::vector<IterationSummary> history = committed_iterations(config.run_directory);
    if (config.relight) remove_directory(config.run_directory + "/before-relight");
    for (const Warnings& found :
         {config.relight ? relight_shortfall(options, stats)
                         : shortfall_of(config.run_directory, stats, config.max_iterations),
          correction_failures(config.run_directory, history)}) {
      console.warnings(found);
      for (const Warning& w : found.all()) warnings.add(w.where, w.what);
    }
    const auto owner = assign_clusters(prepared, config, communicator.size());
    write_run_outputs(outputs_of(options, config),
                      {std::move(prepared), stats, history, owner, warnings}, console.progress());
    if (options.quiet) return;
    console.print(solve_summary(config.run_directory, stats));
    if (shares) console.print(shares_summary(config.run_directory, *shares));
  });
}

/// Replays a recorded run on other computers. RUN gets stats.json and history.json, and no light.
void run_replay(const SolveOptions& options, RankSession& session) {
  Communicator& communicator = session.communicator();
  const SolveConfig config = agree_on_config(options, session);
  Machine& machine = session.machine(options.cost_model);
  RunLock recorded, lock;
  communicator.on_root([&] {
    check_run_directory(config.run_directory);
    recorded.read(options.replay);
    if (read_run_mark(config.run_directory)) lock.write(config.run_directory);
  });
  if (options.trace) machine.trace();
  std::vector<IterationSummary> history;
  RunRecord stats = replay(options.replay, config, communicator, machine,
                           [&history](const IterationSummary& s) { history.push_back(s); });
  communicator.on_root([&] {
    claim_run_directory(config.run_directory, lock);
    remove_run_outputs(config.run_directory);
    describe_strategies(stats, config);
    stats.set("replayed", options.replay);
    write_stats(stats, config.run_directory + "/stats.json");
    replace_file(config.run_directory + "/history.json", history_json(history));
    if (!options.quiet) session.console().print(solve_summary(config.run_directory, stats));
  });
  if (options.trace) write_trace(config.run_directory, communicator, machine);
}

void run_solve_or_replay(const SolveOptions& options, RankSession& session) {
  for (const std::string& note : options.notes) session.console().note(note);
  options.replay.empty() ? run_solve(options, session) : run_replay(options, session);
}

}  // namespace

void add_solve(CLI::App& cli, RankCommand& chosen) {
  add_subcommand(cli, chosen, {solve_name, solve_description, solve_footer}, add_solve_options,
                 run_solve_or_replay);
}

}  // namespace enfilade
