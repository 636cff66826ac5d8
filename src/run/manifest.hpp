// Which iteration of a RUN is committed. Written last and at once, it is what makes an iteration
// real.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coarse/coarse_unknowns.hpp"
#include "hierarchy/cluster_state.hpp"
#include "run/run_layout.hpp"

namespace enfilade {

struct Manifest {
  int iteration = 0;  ///< last committed one; 0 = the state before the first
  std::size_t clusters = 0;
  Basis basis = Basis::constant;
  std::uint64_t scene_hash = 0;
  bool finished = false;  ///< the run has ended
  /// What the iterations did, in numbers that `parallel` understands; needed to go on.
  std::vector<std::vector<double>> history;
  /// What the next iteration corrects this one's light by; may be empty.
  std::vector<double> correction;
  CoarseUnknowns unknowns;  ///< whose they are

  /// The slot that this iteration's patches lie in.
  Slot slot() const { return iteration % 2 == 0 ? Slot::a : Slot::b; }
};

/// None where RUN holds no solution. Throws RunError for a damaged one.
std::optional<Manifest> read_manifest(const RunLayout& layout);
void commit_manifest(const RunLayout& layout, const Manifest& manifest);
/// From now on RUN holds no solution.
void remove_manifest(const RunLayout& layout);

}  // namespace enfilade
