// Shares of the light: their sum against the solution, and each against plain Jacobi iterations on
// one rank; and relighting against a solve of the new scene.
#include <algorithm>

#include "check.hpp"
#include "rooms.hpp"
#include "run/light_shares.hpp"
#include "run/solution.hpp"
#include "schemes/shares/solve_shares.hpp"
#include "shares/share_scene.hpp"
#include "solver/building_field.hpp"

namespace enfilade::spmd_tests {
namespace {

/// The clusters of a solution with room for shares, which are dark.
std::vector<ClusterState> dark_shares(const std::string& run, const Prepared& wide) {
  std::vector<ClusterState> states;
  for (const ClusterState& whole : read_solution(run, true)) {
    ClusterState& state =
        states.emplace_back(same_patches(whole, wide.clusters[whole.id().index()], wide.scene));
    state.set_iteration(gathered_before);
    for (std::size_t n = 0; n < whole.patches().size(); ++n) {
      std::copy(whole.patches().irradiance(n).begin(), whole.patches().irradiance(n).end(),
                state.patches().irradiance(n).begin());
    }
    state.patches().pull();
  }
  return states;
}

/// Shares by Jacobi's iteration over the links of RUN, everything in memory.
std::vector<ClusterState> shares_by_jacobi(const std::string& run, Prepared wide) {
  wide.scene = share_scene(wide.scene, share_groups(wide.scene));
  const Manifest manifest = committed_manifest(RunLayout(run));
  const IterationPlan last = plan_from(manifest.history.back());
  std::vector<ClusterState> states = dark_shares(run, wide);
  const CoarseUnknowns unknowns = coarse_unknowns(wide.clusters, 1);
  BuildingField field(wide, unknowns, manifest.hierarchy);
  const Occluders occluders(wide.clusters);
  GatherConfig config;
  config.refine = config.coarse_row = false;
  config.close_rows = last.close_rows;
  config.openness_rays = last.openness_rays;
  for (int i = 0; i < wide.scene.bands && !last.flux_correction.empty(); ++i)
    config.flux_correction.push_back(last.flux_correction[0]);
  constexpr int iterations = 60;  // 0.7^60 < 1e-9
  for (int k = 0; k < iterations; ++k) {
    for (const ClusterState& state : states)
      if (field.has_tree()) field.set(state.id(), light_of(state));
    field.end_iteration({});
    std::vector<ClusterState> before;
    for (const ClusterState& state : states) before.push_back(state.shooter());
    for (ClusterState& receiver : states) {
      std::vector<ClusterId> listed;
      gather(
          receiver, field.shooters(receiver.id(), listed),
          [&before](ClusterId id) -> const ClusterState& { return before[id.index()]; },
          wide.scene.lights, occluders, config);
    }
  }
  return states;
}

/// Solves until the light stands still, then finds the shares.
void find_shares(Context& context, const Scene& scene, double target_error, bool tree) {
  SolveConfig config;
  config.run_directory = context.directory + "/RUN";
  config.target_error = target_error;
  config.tolerance = 1e-9;
  Prepared prepared = prepared_in(context, config.run_directory, scene);
  SPMD_CHECK(BuildingField::has_tree(config.hierarchy, prepared.clusters.size()) == tree, "tree");
  solve(config, prepared, context.communicator, context.machine);
  const ShareIndex index =
      solve_shares(config, prepared, context.communicator, context.machine, {});
  context.communicator.on_root([&] {
    SPMD_CHECK(index.converged, std::to_string(index.iterations));
    SPMD_CHECK(prepared.scene.bands == 1, "the scene has kept its shares");
    // The shares know nothing of the solution but its links and rows, and sum to it.
    SPMD_CHECK(index.difference < 1e-6, std::to_string(index.difference * 1e9) + "e-9");
    const std::vector<ClusterState> whole = read_solution(config.run_directory);
    const LightShares shares = read_light_shares(config.run_directory, prepared, whole);
    const std::vector<ClusterState> expected = shares_by_jacobi(config.run_directory, prepared);
    double brightest = 0.0, greatest_share = 0.0, worst = 0.0;
    for (const ClusterState& state : whole) {
      for (std::size_t n = 0; n < state.patches().size(); ++n)
        brightest = std::max(brightest, state.patches().irradiance(n)[0]);
    }
    for (const ClusterState& state : whole) {
      for (std::size_t n = 0; n < state.patches().size(); ++n) {
        double sum = 0.0;
        for (std::size_t i = 0; i < shares.size(); ++i) {
          const double share = shares.irradiance(state.id(), n, i, 0);
          const std::size_t at =
              share_band(1, i, 0) * static_cast<std::size_t>(state.patches().terms());
          const double alone = expected[state.id().index()].patches().irradiance(n)[at];
          worst = std::max(worst, std::abs(share - alone));
          sum += share;
          greatest_share = std::max(greatest_share, share);
        }
        const double all = state.patches().irradiance(n)[0];
        SPMD_CHECK(std::abs(sum - all) <= 1e-9 * brightest, std::to_string(sum - all));
      }
    }
    SPMD_CHECK(worst <= 2e-6 * brightest, std::to_string(worst / brightest * 1e9) + "e-9");
    SPMD_CHECK(greatest_share < 0.999 * brightest && shares.size() > 1, "one share is everything");
  });
}

Scene lit_hall_with_switches() {
  Scene scene = lit_hall();
  int lamps = 0;
  for (Surface& surface : scene.surfaces)
    if (surface.object == "lamp") surface.switch_name = lamps++ < 1 ? "first" : "others";
  return scene;
}

}  // namespace

void shares_sum_to_the_light(Context& context) { find_shares(context, lit_rooms(), 0.05, false); }

void shares_of_a_tree_sum_to_the_light(Context& context) {
  find_shares(context, lit_hall_with_switches(), 0.2, true);
}

/// Other reflectances, a dimmer lamp and a luminaire that turns: over the links of the run, and as
/// a solve of its own.
void relit_rooms_are_the_solved_ones(Context& context) {
  SolveConfig config;
  config.run_directory = context.directory + "/RUN";
  config.target_error = 0.02;
  const Scene before = lit_rooms();
  const Prepared first = prepared_in(context, config.run_directory, before);
  const RunRecord record = solve(config, first, context.communicator, context.machine);

  Scene now = before;
  for (Surface& surface : now.surfaces) {
    surface.reflectance[0] = 0.9 - surface.reflectance[0];
    for (double& exitance : surface.exitance) exitance *= 0.3;
  }
  now.lights[0].frame = LightFrame::of({-0.5, 0.3, -1.0}, {0.0, 1.0, 0.0}).value();
  SolveConfig again = config;
  again.run_directory = context.directory + "/NEW";
  const Prepared prepared = prepared_in(context, again.run_directory, now);
  solve(again, prepared, context.communicator, context.machine);
  std::vector<double> expected;
  context.communicator.on_root(
      [&] { expected = mean_radiosities(read_solution(again.run_directory)); });

  again.run_directory = context.directory + "/RELIT";
  const Prepared same = prepared_in(context, again.run_directory, now);
  again.epsilon = 1e-3;
  again.relight = Relight{config.run_directory, lights_with_links(same.scene, first.scene), {0}};
  SPMD_CHECK(again.relight->old_light == std::vector{Relight::none}, "a luminaire that has turned");
  const RunRecord relit = solve(again, same, context.communicator, context.machine);
  context.communicator.on_root([&] {
    const std::vector<double> got = mean_radiosities(read_solution(again.run_directory));
    double wrong = 0.0, all = 0.0;
    for (std::size_t i = 0; i < got.size(); ++i) {
      wrong += std::abs(got[i] - expected[i]) * same.clusters[i].area_m2;
      all += expected[i] * same.clusters[i].area_m2;
    }
    const double error = relit.number("estimated_error", 1.0);
    SPMD_CHECK(wrong <= (error + 0.02) * all && error < 0.1,
               std::to_string(wrong / all) + ", estimated " + std::to_string(error));
    SPMD_CHECK(relit.number("form_factors", 1e9) < 0.5 * record.number("form_factors", 0),
               std::to_string(relit.number("form_factors", 0)) + " form factors");
  });
}

}  // namespace enfilade::spmd_tests
