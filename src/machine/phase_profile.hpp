// The phases of a rank over time, in bins that grow with the run: of bounded size for a run of any
// length, and the same in every simulation.
#pragma once

#include <array>
#include <vector>

namespace enfilade {

/// Activity of a rank; every second of a run belongs to one phase. compute: gathers; io: reads,
/// writes and moves files; commit: makes an iteration the committed one; steal: waits for a stolen
/// cluster; wait: waits for work from a master, or as a master for its slaves; token: waits for the
/// end of the iteration.
enum class Phase : unsigned char { compute, io, commit, steal, wait, token };
inline constexpr std::size_t phase_count = 6;

class PhaseProfile {
 public:
  using Bin = std::array<double, phase_count>;  ///< seconds by phase

  explicit PhaseProfile(double bin_s = 1e-3, std::vector<Bin> bins = {})
      : bin_s_(bin_s), bins_(std::move(bins)) {}
  /// Adds a span, in seconds since the start, that lies after all spans before. Where more than
  /// `most_bins` are needed, neighbouring bins are merged.
  void add(Phase phase, double from_s, double to_s);
  /// Merges neighbouring bins until they are at least this wide; the width doubles each time.
  void widen(double bin_s);

  double bin_s() const { return bin_s_; }
  const std::vector<Bin>& bins() const { return bins_; }
  static constexpr std::size_t most_bins = 2048;  ///< bounds the size of a profile

 private:
  void merge_neighbours();

  double bin_s_;
  std::vector<Bin> bins_;
};

}  // namespace enfilade
