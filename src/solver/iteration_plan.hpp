// The plan of an iteration, its summary, and the planner.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/work_count.hpp"
#include "gather/gather.hpp"

namespace enfilade {

/// Decided on rank 0, sent with the second tour of the token; the same on every rank.
struct IterationPlan {
  int iteration = 1;            ///< the one that the plan is for; 0 is the state before the first
  double link_tolerance = 0.0;  ///< GatherConfig::link_tolerance
  bool refine = true;
  bool renew_far = true;        ///< RefinementConfig::renew_far
  bool close_rows = false;      ///< GatherConfig::close_rows
  OpennessRays openness_rays;   ///< more of them where a run goes on with a smaller target error
  bool sample = false;          ///< sample the error: ErrorSamples
  int sample_rays = 0;          ///< per sampled point
  double received_power = 0.0;  ///< power received in the previous iteration
  double relaxation = 1.0;      ///< GatherConfig::relaxation
  double extrapolation = 0.0;   ///< GatherConfig::extrapolation
  Spectrum flux_correction;     ///< GatherConfig::flux_correction
  bool finished = false;        ///< there is no such iteration: the run ends
  bool converged = false;       ///< it ends because it is good enough, not because it gave up
};

/// Errors of the irradiance, relative, area-weighted L1; see error_estimate.hpp.
struct ErrorEstimate {
  /// For light by final gather at a point.
  double discretisation = 0.0, visibility = 0.0, iteration = 0.0;
  double patches = 0.0;          ///< for light taken from the patches, all parts together
  double iteration_bound = 0.0;  ///< estimated bound of the changes by later iterations
  double total() const { return discretisation + visibility + iteration; }
};

/// One committed iteration.
struct IterationSummary {
  IterationPlan plan;
  IterationFigures figures;
  /// By the coarse correction; absorbed and escaping powers include the correction.
  bool corrected = false;
  bool correction_failed = false;  ///< the coarse system had no finite solution: no correction
  double missing_power = 0.0;      ///< remaining power, estimated by the correction
  ErrorEstimate error;
  double time_s = 0.0;  ///< since the start of the solve: wall clock or simulated
};

/// Called after every iteration.
using IterationObserver = std::function<void(const IterationSummary&)>;

/// The thresholds and factors of next_plan(). Measured ones come from sweeps over dense rooms and
/// houses (bench/accuracy.md); the others are choices, with their reason.
struct PlanWeights {
  /// First link tolerance over emitted power, as a share of the target error. Coarse on purpose:
  /// sampling shows links that are too coarse, and refinement is never undone.
  double first_epsilon_share = 2.5e-3;
  /// That of a building with at most so many clusters; in a larger one the tolerance is a share of
  /// the power of so many. A link's error is absolute: a share of all power would leave each part
  /// of a building coarser, the more there is beside it. With a share of all power, 14,300 clusters
  /// (schependomlaan) had the right light, and 43,000 (10 storeys) lacked a quarter of it.
  double clusters_at_first_epsilon = 16000.0;
  /// The same is so many times coarser where errors count at points alone: importance makes links
  /// finer by itself where they matter.
  double first_at_points = 4.0;
  /// Once light is everywhere, the first tolerance is kept until the light has grown by more than
  /// this, as it does where nearly all is reflected.
  double outgrown = 2.0;
  /// Share of the target error that is left to the iterations (what fine_share leaves); also the
  /// floor of the flux correction.
  double iteration_share = 0.05;
  /// Light counts as fully distributed once the relative change of an iteration falls below this.
  double settled_change = 0.1;
  /// Links count as stable when at most one in links_per_refined was refined in an iteration.
  double links_per_refined = 1000.0;
  /// The sum of the links' errors falls with their tolerance to the power of 1 / tolerance_order
  /// (measured).
  double tolerance_order = 3.0;
  /// Links are fine enough where their error is below fine_share of the target; a tightening aims
  /// at aim_share.
  double fine_share = 0.95, aim_share = 0.8;
  /// Bounds of the factor by which one step tightens the tolerance.
  double most_tightening = 1.0 / 32.0, least_tightening = 0.7;
  /// The number of links grows with the tolerance to the power of -1 / link_order (measured: 1.3 to
  /// 1.9). Where only values read off patches need finer links, a step does not aim beyond
  /// patch_links.
  double link_order = 1.5;
  /// Refinement stagnates where a tolerance finer by much_finer brought less than stagnation_share
  /// of the order that is expected, and as much again would not reach the target.
  double much_finer = 1.0 / 8.0, stagnation_share = 0.5;
  /// Rays of a sampled point: sample_rays_times_target / target_error, within these limits. Noise
  /// is measured and subtracted; it need only stay below the target error.
  double sample_rays_times_target = 4.0, least_sample_rays = 64.0, most_sample_rays = 1024.0;
};

/// True where so few links were refined that the light comes to rest all the same: at most one in
/// `per` (PlanWeights::links_per_refined).
bool few_links_refined(const IterationSummary& iteration,
                       double per = PlanWeights{}.links_per_refined);

/// Power that surfaces emit.
struct SurfacesPower {
  Spectrum bands;
  bool panes = false;  ///< the scene has panes, which take in an unknown part of it

  SurfacesPower() = default;
  SurfacesPower(Spectrum per_band, bool with_panes = false)
      : bands(std::move(per_band)), panes(with_panes) {}
  SurfacesPower(std::initializer_list<double> per_band) : bands(per_band) {}
};

struct PlanConfig {
  Spectrum emitted_power;
  SurfacesPower surfaces_power;  ///< the part of emitted_power that surfaces emit
  double epsilon = 0.0;  ///< link tolerance over emitted power (worst band); 0 = from target_error
  double tolerance = 0.0;  ///< stop below this iteration_bound; 0 = from target_error
  double target_error = 0.02;
  std::size_t clusters = 0;       ///< of the building
  std::uint64_t patch_links = 0;  ///< with more links than this, target_error applies only to
                                  ///< final-gathered light; 0 = never
  int max_iterations = 200;
  bool at_points = false;  ///< errors count by their importance to points
  PlanWeights weights{};
};

/// Returns the plan of iteration 1.
IterationPlan first_plan(const PlanConfig& config);
/// Returns the plan of the iteration after the last of `history` (all iterations so far, in order).
/// A pure function.
IterationPlan next_plan(std::span<const IterationSummary> history, const PlanConfig& config);

/// Conversion to and from plain numbers, for messages and the manifest. `plan_from` and
/// `summary_from` throw RunError where the numbers do not encode one.
std::vector<double> to_numbers(const IterationPlan& plan);
IterationPlan plan_from(std::span<const double> numbers);
std::vector<double> to_numbers(const IterationSummary& summary);
IterationSummary summary_from(std::span<const double> numbers);

}  // namespace enfilade
