// The whole solve on a furnace: every surface sends out (1 - reflectance) H, so that E = B = H
// everywhere. Two rooms joined by a door, a crate in one of them.
#include <filesystem>
#include <iostream>

#include "check.hpp"
#include "run/manifest.hpp"
#include "run/prepare.hpp"
#include "run/solution.hpp"
#include "scene_file/scene_io.hpp"
#include "schemes/protocol/prepare_on_root.hpp"
#include "schemes/replay/replay.hpp"
#include "schemes/solve/solve.hpp"

namespace enfilade::spmd_tests {
namespace {

constexpr double reflectance = 0.5, level = 3.0;

void add_quad(Scene& scene, const std::string& object, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  Surface s;
  s.vertices = {a, b, c, d};
  s.reflectance = {reflectance};
  s.exitance = {(1.0 - reflectance) * level};
  s.object = object;
  scene.surfaces.push_back(s);
}

/// The six sides of a box, facing in or out.
void add_box(Scene& scene, const std::string& object, Vec3 lo, Vec3 hi, bool inwards) {
  const auto side = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    inwards ? add_quad(scene, object, a, b, c, d) : add_quad(scene, object, d, c, b, a);
  };
  const auto at = [&](int x, int y, int z) {
    return Vec3(x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z);
  };
  side(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0));
  side(at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1));
  side(at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0));
  side(at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1));
  side(at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1));
  side(at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0));
}

/// A wall with a door, seen from both rooms: two jambs and a lintel, 0.2 m thick.
Scene furnace() {
  Scene scene;
  add_box(scene, "house", {0, 0, 0}, {8.2, 4, 2.5}, true);
  add_box(scene, "jamb 1", {4, 0, 0}, {4.2, 1.5, 2.5}, false);
  add_box(scene, "jamb 2", {4, 2.5, 0}, {4.2, 4, 2.5}, false);
  add_box(scene, "lintel", {4, 1.5, 2.0}, {4.2, 2.5, 2.5}, false);
  add_box(scene, "crate", {1, 1, 0.3}, {1.7, 2.2, 1.1}, false);
  return scene;
}

/// The furnace, prepared in RUN; with --resume, RUN is kept.
Prepared prepared_furnace(Context& context, const std::string& run) {
  const std::string scene_file = context.directory + "/furnace.json";
  context.communicator.barrier();  // a solve before has left its local directories on every rank
  context.communicator.on_root([&] {
    if (!context.resume) std::filesystem::remove_all(run);
    write_scene(furnace(), scene_file);
  });
  Warnings warnings;
  return prepare_on_root(
      context.communicator,
      [&scene_file](Warnings& found) { return read_scene(scene_file, found); }, run, {}, warnings);
}

/// Mean radiosity of each cluster; on rank 0.
std::vector<double> radiosities(const std::string& run) {
  std::vector<double> means;
  for (const ClusterState& state : read_solution(run)) {
    double power = 0.0, area = 0.0;
    for (std::size_t i = 0; i < state.patches().polygons(); ++i) {
      power += state.patches().node(i).shape.area_m2 * state.patches().radiosity(i)[0];
      area += state.patches().node(i).shape.area_m2;
    }
    means.push_back(power / area);
  }
  return means;
}

}  // namespace

namespace {

/// Relative, area-weighted L1 error of the radiosity in RUN.
double error_of(const std::string& run) {
  double area = 0.0, wrong = 0.0;
  for (const ClusterState& state : read_solution(run)) {
    const PatchForest& forest = state.patches();
    for (std::size_t i = 0; i < forest.size(); ++i) {
      if (!forest.node(i).leaf()) continue;
      area += forest.node(i).shape.area_m2;
      wrong += forest.node(i).shape.area_m2 * std::abs(forest.radiosity(i)[0] / level - 1.0);
    }
  }
  return wrong / area;
}

/// Solves the furnace as `config` has it; the record on rank 0.
RunRecord solve_furnace(Context& context, SolveConfig config) {
  const std::string run = context.directory + "/RUN";
  const Prepared prepared = prepared_furnace(context, run);
  config.run_directory = run;
  config.target_error = 0.05;
  config.resume = context.resume;
  int seen = 0;
  RunRecord record = solve(config, prepared, context.communicator, context.machine,
                           [&](const IterationSummary&) { ++seen; });
  context.communicator.on_root([&] {
    const double iterations = record.number("iterations", 0);
    if (context.resume) {
      SPMD_CHECK(iterations >= seen, std::to_string(seen) + " iterations seen");
    } else {
      SPMD_CHECK(iterations == seen && seen > 1, std::to_string(seen) + " iterations seen");
      SPMD_CHECK(record.number("bytes_written", 0) > 0, "bytes_written");
    }
    SPMD_CHECK(record.number("ranks", 0) == context.communicator.size(), "ranks");
    SPMD_CHECK(error_of(run) < 0.05, std::to_string(error_of(run)));
  });
  return record;
}

/// For a run that is killed and resumed: iterates until the light stands still.
void solve_to_the_end(Context& context, Scheme scheme) {
  SolveConfig config;
  config.scheme = scheme;
  config.coarse_correction = false;
  config.tolerance = 1e-9;
  const RunRecord record = solve_furnace(context, config);
  context.communicator.on_root([&] {
    std::cout << "ended after iteration " << record.number("iterations", 0) << std::endl;
  });
}

/// With several ranks the clusters go by messages, and rank 0 alone has files; one rank sends none.
void solve_rooms_with_a_master(Context& context, Scheme scheme) {
  SolveConfig config;
  config.scheme = scheme;
  solve_furnace(context, config);
  config.coarse_correction = false;  // whose numbers are by far the longest of spmd's messages
  const RunRecord dealt = solve_furnace(context, config);
  config.steal = false;
  const RunRecord planned = solve_furnace(context, config);
  config = SolveConfig{};
  config.coarse_correction = false;
  const RunRecord spmd = solve_furnace(context, config);
  context.communicator.on_root([&] {
    SPMD_CHECK(planned.number("steals", 1) == 0, "stolen without stealing");
    if (context.communicator.size() == 1) return;
    const double sent = dealt.number("message_bytes", 0), few = spmd.number("message_bytes", 0);
    SPMD_CHECK(sent > 10.0 * few, std::to_string(sent) + " and " + std::to_string(few));
    const double clusters = spmd.number("clusters", 0), rounds = dealt.number("iterations", 0);
    SPMD_CHECK(dealt.number("messages", 0) > clusters * rounds, "a result of each gather");
  });
}

}  // namespace

void solve_rooms(Context& context) { solve_furnace(context, {}); }

void solve_rooms_as_in_the_paper(Context& context) {
  SolveConfig config;
  config.coarse_correction = false;
  solve_furnace(context, config);
}

void solve_rooms_master_slave(Context& context) {
  solve_rooms_with_a_master(context, Scheme::master_slave);
}

void solve_rooms_replicated(Context& context) {
  solve_rooms_with_a_master(context, Scheme::replicated);
}

void solve_to_the_end_spmd(Context& context) { solve_to_the_end(context, Scheme::spmd); }
void solve_to_the_end_master_slave(Context& context) {
  solve_to_the_end(context, Scheme::master_slave);
}
void solve_to_the_end_replicated(Context& context) {
  solve_to_the_end(context, Scheme::replicated);
}

void solve_rooms_by_jacobi(Context& context) {
  SolveConfig config;
  config.coarse_correction = false;
  config.tolerance = 1e-6;
  const double seidel = solve_furnace(context, config).number("iterations", 0);
  config.jacobi = true;
  const double jacobi = solve_furnace(context, config).number("iterations", 0);
  context.communicator.on_root([&] {
    SPMD_CHECK(jacobi > seidel, std::to_string(jacobi) + " iterations, " + std::to_string(seidel));
  });
}

void solve_in_little_memory(Context& context) {
  // A budget of a quarter of the clusters' size: the same solution, to the digit on one rank, and
  // more bytes read.
  Communicator& c = context.communicator;
  const std::string run = context.directory + "/RUN";
  const Prepared prepared = prepared_furnace(context, run);
  SolveConfig config;
  config.run_directory = run;
  config.target_error = 0.05;
  const RunRecord rich = solve(config, prepared, c, context.machine);
  std::vector<double> expected;
  c.on_root([&] { expected = radiosities(run); });
  config.memory_bytes = std::stoull(
      c.broadcast(std::to_string(std::llround(rich.number("peak_cluster_bytes", 0.0) / 4.0))));
  const RunRecord poor = solve(config, prepared, c, context.machine);
  c.on_root([&] {
    const std::vector<double> got = radiosities(run);
    for (std::size_t i = 0; i < got.size(); ++i) {
      const double tolerance = c.size() == 1 ? 0.0 : 0.02 * level;
      SPMD_CHECK(std::abs(got[i] - expected[i]) <= tolerance, std::to_string(got[i] - expected[i]));
    }
    SPMD_CHECK(poor.number("bytes_read", 0) > rich.number("bytes_read", 0),
               "nothing was read again");
    const double peak = poor.number("peak_cluster_bytes", 0);
    SPMD_CHECK(peak < 0.75 * rich.number("peak_cluster_bytes", 0), std::to_string(peak));
    SPMD_CHECK(
        peak <= static_cast<double>(config.memory_bytes) + poor.number("over_budget_bytes", 0),
        "more in memory than the run reports");
  });
}

/// A replay takes the same steps as the recorded run, with the coarse correction and without. In
/// little memory it is near and not the same: the memory of a cluster during its refinement is not
/// recorded, so that other clusters may be evicted.
void replay_rooms(Context& context) {
  for (const bool little : {false, true}) {
    const std::string run = context.directory + (little ? "/LITTLE" : "/RUN");
    const Prepared prepared = prepared_furnace(context, run);
    SolveConfig config;
    config.run_directory = run;
    config.target_error = 0.1;
    config.coarse_correction = !little;
    config.memory_bytes = little ? 60'000 : 0;
    const RunRecord solved = solve(config, prepared, context.communicator, context.machine);
    config.run_directory = context.directory + "/REPLAYED";
    const RunRecord again = replay(run, config, context.communicator, context.machine);
    context.communicator.on_root([&] {
      const double full_s = solved.number("simulated_s", 0),
                   replayed_s = again.number("simulated_s", 0);
      SPMD_CHECK(full_s > 0.0 && std::abs(replayed_s / full_s - 1.0) < 1e-3,
                 std::to_string(full_s) + " s, replayed " + std::to_string(replayed_s) + " s");
      if (little) return;
      for (const char* key : {"bytes_read", "bytes_written", "messages", "message_bytes", "steals",
                              "links", "rays", "peak_cluster_bytes"}) {
        const double one = solved.number(key, -1), other = again.number(key, -2);
        SPMD_CHECK(one == other, std::string(key) + " " + std::to_string(one) + ", replayed " +
                                     std::to_string(other));
      }
    });
  }
}

}  // namespace enfilade::spmd_tests
