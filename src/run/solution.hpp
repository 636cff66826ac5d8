// The solution that a RUN directory holds.
#pragma once

#include <string>
#include <vector>

#include "hierarchy/cluster_state.hpp"
#include "run/manifest.hpp"
#include "run/sections/run_layout.hpp"
#include "run/sections/segment_file.hpp"

namespace enfilade {

/// Reads clusters of the last committed iteration.
class SolutionReader {
 public:
  /// `manifest`: of this RUN. Throws RunError for a damaged table.
  SolutionReader(const RunLayout& layout, const Manifest& manifest);

  /// Returns a cluster after the iteration's coarse correction; with its links if `links`. Throws
  /// RunError for a file that is missing, damaged or of another run.
  ClusterState read(ClusterId id, bool links) const;

 private:
  std::string run_directory_, common_;
  Manifest manifest_;
  SegmentIndex geometry_, patches_;
};

/// Returns all clusters of the last committed iteration, in order of their ids; with their links if
/// `links`. Throws InputError where RUN holds no solution, RunError as SolutionReader does.
std::vector<ClusterState> read_solution(const std::string& run_directory, bool links = false);

}  // namespace enfilade
