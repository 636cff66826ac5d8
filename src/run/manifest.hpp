// The manifest: which iteration of a RUN is committed. It is replaced at once, after all files of
// the iteration are in place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coarse/coarse_unknowns.hpp"
#include "hierarchy/cluster_state.hpp"
#include "run/sections/run_layout.hpp"
#include "solver/building_field.hpp"

namespace enfilade {

/// 13: rays of openness. 12: surplus of error samples. 11: segments. 10: kept light, extrapolation.
/// 9: sums of rows, relaxation. 8: checksum, run and preparation. 7: the building's hierarchy.
inline constexpr int manifest_version = 13;

struct Manifest {
  int iteration = 0;  ///< the last committed one; 0 = the state before the first
  std::size_t clusters = 0;
  int ranks = 1;  ///< as many as have written the segments, in all iterations
  Basis basis = Basis::constant;
  Hierarchy hierarchy = Hierarchy::building;
  std::uint64_t scene_hash = 0;
  std::uint64_t preparation = 0;  ///< Prepared::preparation
  std::uint64_t run = 0;          ///< names the run: SectionPlace::run of all its files
  bool finished = false;          ///< the run has ended
  /// Plan and figures of each iteration, as to_numbers() of solver/iteration_plan.hpp gives them.
  std::vector<std::vector<double>> history;
  /// The coarse correction of this iteration's light, [unknown * bands + band]; may be empty.
  std::vector<double> correction;
  CoarseUnknowns unknowns;  ///< which unknowns of the correction belong to which cluster
};

/// Reads the manifest; none where RUN holds no solution. Throws RunError for a manifest that is
/// damaged (checksum) or of another version.
std::optional<Manifest> read_manifest(const RunLayout& layout);
/// The same where there must be one, and of what RUN is prepared for. Throws InputError where RUN
/// holds no solution.
Manifest committed_manifest(const RunLayout& layout);
/// Commits the iteration. Once a run is finished, its files are flushed to the disk as well.
void commit_manifest(const RunLayout& layout, const Manifest& manifest);
/// Removes the manifest, so that RUN holds no solution.
void remove_manifest(const RunLayout& layout);

}  // namespace enfilade
