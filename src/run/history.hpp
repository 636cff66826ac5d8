// The committed iterations of a run, from its manifest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/manifest.hpp"
#include "run/sections/run_layout.hpp"
#include "solver/iteration_plan.hpp"

namespace enfilade {

/// Returns the iterations up to the committed one. Includes iterations from before a crash; none
/// where nothing is committed.
inline std::vector<IterationSummary> history_of(const std::optional<Manifest>& manifest) {
  std::vector<IterationSummary> history;
  if (!manifest) return history;
  for (const auto& numbers : manifest->history) history.push_back(summary_from(numbers));
  return history;
}

inline std::vector<IterationSummary> committed_iterations(const std::string& run_directory) {
  return history_of(read_manifest(RunLayout(run_directory)));
}

}  // namespace enfilade
