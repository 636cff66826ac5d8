// What an iteration is told to do, what it did, and what follows from that.
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
  bool close_rows = false;      ///< GatherConfig::close_rows
  bool sample = false;          ///< gather anew at sampled points: ErrorSamples
  int sample_rays = 0;          ///< a point
  double received_power = 0.0;  ///< of the iteration before
  Spectrum flux_correction;     ///< GatherConfig::flux_correction
  bool finished = false;        ///< there is no such iteration: the run ends
  bool converged = false;       ///< it ends because it is good enough, not because it gave up
};

/// Errors of the irradiance, relative, area-weighted L1; see error_estimate.hpp.
struct ErrorEstimate {
  double discretisation = 0.0, visibility = 0.0, iteration = 0.0;  ///< of points gathered for
  double patches = 0.0;          ///< of what is read off the patches, all parts together
  double iteration_bound = 0.0;  ///< what iterations to come may still change, estimated
  double total() const { return discretisation + visibility + iteration; }
};

/// One committed iteration.
struct IterationSummary {
  IterationPlan plan;
  IterationFigures figures;
  bool corrected = false;  ///< by the coarse system; what is absorbed and escapes is after that
  bool correction_failed = false;  ///< the coarse system had no solution, and was left out
  double missing_power = 0.0;      ///< what the coarse system says the iteration still lacked
  ErrorEstimate error;
  double time_s = 0.0;  ///< since the start of the solve: wall clock or simulated
};

/// Called after every iteration.
using IterationObserver = std::function<void(const IterationSummary&)>;

/// The numbers that decide in next_plan(). Measured ones come from sweeps over dense rooms and
/// houses (bench/accuracy.md); the others are choices, with their reason.
struct PlanWeights {
  /// First link tolerance over emitted power, as a share of the target error. Coarse on purpose:
  /// what is too coarse is found by sampling, what is too fine is never taken back.
  double first_epsilon_share = 2.5e-3;
  /// Share of the target error that is left to the iterations; also the floor of the flux
  /// correction.
  double iteration_share = 0.02;
  /// Light has been everywhere once an iteration changes it by less than this share.
  double settled_change = 0.1;
  /// Links rest where no more than one in so many was refined in an iteration.
  double links_per_refined = 1000.0;
  /// The sum of the links' errors falls with their tolerance to the power of 1 / tolerance_order
  /// (measured).
  double tolerance_order = 3.0;
  /// Links are fine enough below this share of the target; a finer tolerance aims at aim_share.
  double fine_share = 0.9, aim_share = 0.8;
  /// Bounds of the factor by which one step tightens the tolerance.
  double most_tightening = 1.0 / 32.0, least_tightening = 0.7;
  /// Refinement stagnates where a tolerance finer by much_finer brought less than stagnation_share
  /// of the order that is expected.
  double much_finer = 1.0 / 8.0, stagnation_share = 0.5;
  /// Rays of a sampled point: sample_rays_times_target / target_error, within these limits. Noise
  /// is measured and taken off; it only must not drown the asked error.
  double sample_rays_times_target = 4.0, least_sample_rays = 64.0, most_sample_rays = 1024.0;
};

struct PlanConfig {
  Spectrum emitted_power;
  Spectrum surfaces_power;  ///< what of that surfaces send out (energy_conservation.hpp)
  double epsilon = 0.0;  ///< link tolerance over emitted power (worst band); 0 = from target_error
  double tolerance = 0.0;  ///< stop below this iteration_bound; 0 = from target_error
  double target_error = 0.02;
  std::uint64_t patch_links =
      0;  ///< with more links than this only gathered light is held to it; 0 = never
  int max_iterations = 200;
  PlanWeights weights{};
};

/// Plan of iteration 1.
IterationPlan first_plan(const PlanConfig& config);
/// Plan of the iteration after the last of `history` (all iterations so far, in order). Pure.
IterationPlan next_plan(std::span<const IterationSummary> history, const PlanConfig& config);

/// To and from plain numbers, for messages and the manifest. `*_from` throw RunError for numbers
/// that are none.
std::vector<double> to_numbers(const IterationPlan& plan);
IterationPlan plan_from(std::span<const double> numbers);
std::vector<double> to_numbers(const IterationSummary& summary);
IterationSummary summary_from(std::span<const double> numbers);

}  // namespace enfilade
