// What `solve` prints: progress while it works, and a table at its end.
#pragma once

#include <string>

#include "base/progress.hpp"
#include "base/run_record.hpp"
#include "base/warnings.hpp"
#include "run/light_shares.hpp"
#include "schemes/solve/solve.hpp"

namespace enfilade {

/// Turns committed iterations into progress: the share of the way from the first iteration's error
/// to the target error, on a logarithmic scale.
class SolveProgress {
 public:
  SolveProgress(double target_error, Progress progress)
      : target_error_(target_error), progress_(std::move(progress)) {}

  /// Refers to this object.
  IterationObserver observer();

 private:
  double fraction(double error);

  double target_error_;
  Progress progress_;
  double first_error_ = 0.0;  ///< 0 = no iteration yet
};

/// Returns the table at the end of a solve; `record` is that of RUN/stats.json.
std::string solve_summary(const std::string& run_directory, const RunRecord& record);

/// Returns a warning with the estimate and the remedy, where the solve gave up before it converged.
Warnings shortfall_of(const std::string& run_directory, const RunRecord& record,
                      int max_iterations);

/// Returns a warning with the number of iterations whose coarse correction could not be solved.
Warnings correction_failures(const std::string& run_directory,
                             const std::vector<IterationSummary>& history);

/// Enters the figures of the shares in the record of the solve.
void describe_shares(RunRecord& record, const ShareIndex& shares);
/// Returns the table of the shares.
std::string shares_summary(const std::string& run_directory, const ShareIndex& shares);
/// Returns a warning where the shares' iterations did not converge.
Warnings shares_shortfall(const std::string& run_directory, const ShareIndex& shares);

}  // namespace enfilade
