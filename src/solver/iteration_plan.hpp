// What an iteration is told to do, what it did, and what follows from that.
#pragma once

#include <cstdint>
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
  IterationFigures sums;
  bool corrected = false;  ///< by the coarse system; what is absorbed and escapes is after that
  bool correction_failed = false;  ///< the coarse system had no solution, and was left out
  double missing_power = 0.0;      ///< what the coarse system says the iteration still lacked
  ErrorEstimate error;
  double time_s = 0.0;  ///< since the start of the solve: wall clock or simulated
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
