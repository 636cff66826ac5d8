// The whole solve: on a furnace, whose light is known; and every scheme against the sequential
// solver.
#include <algorithm>
#include <iostream>

#include "check.hpp"
#include "rooms.hpp"
#include "run/manifest.hpp"
#include "run/solution.hpp"
#include "schemes/replay/replay.hpp"
#include "schemes/solve/solve.hpp"
#include "solver/sequential_solver.hpp"

namespace enfilade::spmd_tests {
namespace {

/// How far the light in RUN is off, as a share.
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
  const Prepared prepared = prepared_in(context, run, furnace());
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
  config.method.coarse_correction = false;
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
  config.method.coarse_correction =
      false;  // whose numbers are by far the longest of spmd's messages
  const RunRecord dealt = solve_furnace(context, config);
  config.steal = false;
  const RunRecord planned = solve_furnace(context, config);
  config = SolveConfig{};
  config.method.coarse_correction = false;
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
  config.method.coarse_correction = false;
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
  config.method.coarse_correction = false;
  config.tolerance = 1e-6;
  const double seidel = solve_furnace(context, config).number("iterations", 0);
  config.method.jacobi = true;
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
  const Prepared prepared = prepared_in(context, run, lit_rooms());
  SolveConfig config;
  config.run_directory = run;
  config.target_error = 0.05;
  const RunRecord rich = solve(config, prepared, c, context.machine);
  std::vector<double> expected;
  c.on_root([&] { expected = mean_radiosities(read_solution(run)); });
  config.memory_bytes = std::stoull(
      c.broadcast(std::to_string(std::llround(rich.number("peak_cluster_bytes", 0.0) / 4.0))));
  const RunRecord poor = solve(config, prepared, c, context.machine);
  c.on_root([&] {
    const std::vector<double> got = mean_radiosities(read_solution(run));
    const double brightest = *std::max_element(expected.begin(), expected.end());
    for (std::size_t i = 0; i < got.size(); ++i) {
      const double tolerance = c.size() == 1 ? 0.0 : 0.02 * brightest;
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

namespace {

/// Solves the prepared scene by each of the schemes, and compares with the sequential solver.
void compare_with_sequential(Context& context, const Prepared& prepared, const SolveConfig& asked,
                             std::initializer_list<Scheme> schemes) {
  for (const Scheme scheme : schemes) {
    SolveConfig config = asked;
    config.method.jacobi = true;
    config.scheme = scheme;
    config.hierarchy = config.topmost();
    const RunRecord record = solve(config, prepared, context.communicator, context.machine);
    context.communicator.on_root([&] {
      const Solution expected = solve_sequentially(prepared, Occluders(prepared.clusters), config);
      const auto want = all_radiosities(expected.clusters);
      const auto got = all_radiosities(read_solution(config.run_directory));
      SPMD_CHECK(got.size() == want.size(), std::to_string(want.size()));
      double brightest = 0.0, least = 1e300;
      for (const double b : mean_radiosities(expected.clusters)) {
        brightest = std::max(brightest, b);
        least = std::min(least, b);
      }
      SPMD_CHECK(least < 0.1 * brightest, "light that is nearly uniform shows no swapped patch");
      for (std::size_t i = 0; i < want.size(); ++i) {
        SPMD_CHECK(std::abs(got[i] - want[i]) <= 1e-9 * brightest,
                   std::string(name_of(scheme)) + ", coefficient " + std::to_string(i) + ": " +
                       std::to_string(got[i]) + " for " + std::to_string(want[i]));
      }
      const auto& last = expected.history.back();
      SPMD_CHECK(record.number("iterations", 0) == static_cast<double>(expected.history.size()),
                 std::to_string(expected.history.size()));
      SPMD_CHECK(record.number("links", 0) == static_cast<double>(last.figures.links),
                 std::to_string(last.figures.links));
      SPMD_CHECK(std::abs(record.number("estimated_error", 0) - last.error.total()) < 1e-9,
                 std::to_string(last.error.total()));
    });
  }
}

}  // namespace

/// By Jacobi's method the light does not depend on who gathers when: each scheme gives the
/// sequential solver's light to rounding, in as many iterations and with as many links.
void schemes_give_the_sequential_light(Context& context) {
  SolveConfig config;
  config.run_directory = context.directory + "/RUN";
  config.target_error = 0.05;
  compare_with_sequential(context, prepared_in(context, config.run_directory, lit_rooms()), config,
                          {Scheme::spmd, Scheme::master_slave, Scheme::replicated});
}

/// The same where far groups of clusters shoot as one, and their light goes round with the token.
void far_light_is_the_sequential_one(Context& context) {
  SolveConfig config;
  config.run_directory = context.directory + "/RUN";
  config.target_error = 0.2;
  const Prepared prepared = prepared_in(context, config.run_directory, lit_hall());
  SPMD_CHECK(BuildingField::has_tree(config.hierarchy, prepared.clusters.size()),
             std::to_string(prepared.clusters.size()));
  compare_with_sequential(context, prepared, config, {Scheme::spmd});
}

/// A replay goes through the same moves as the run that it was recorded from, with the coarse
/// correction and without. Where memory is short, what a cluster took while it was refined is not
/// recorded, so that other clusters may be evicted: near, and not the same.
void replay_rooms(Context& context) {
  for (const bool little : {false, true}) {
    const std::string run = context.directory + (little ? "/LITTLE" : "/RUN");
    const Prepared prepared = prepared_in(context, run, furnace());
    SolveConfig config;
    config.run_directory = run;
    config.target_error = 0.1;
    config.method.coarse_correction = !little;
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
