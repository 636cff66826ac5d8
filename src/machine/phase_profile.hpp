// What a rank did over time, in bins that grow with the run: small for a run of any length, the
// same in every simulation.
#pragma once

#include <array>
#include <vector>

namespace enfilade {

/// What a rank is doing; every second of a run belongs to one phase.
enum class Phase : unsigned char { compute, io, commit, steal, wait, token };
inline constexpr std::size_t phase_count = 6;

class PhaseProfile {
 public:
  using Bin = std::array<double, phase_count>;  ///< seconds by phase

  explicit PhaseProfile(double bin_s = 1e-3, std::vector<Bin> bins = {})
      : bin_s_(bin_s), bins_(std::move(bins)) {}
  /// From `from_s` to `to_s`, which are never earlier than those before. At most `most_bins`
  /// remain: where there are more, neighbours become one.
  void add(Phase phase, double from_s, double to_s);
  /// Bins of at least this width: the old one, doubled as often as it takes.
  void widen(double bin_s);

  double bin_s() const { return bin_s_; }
  const std::vector<Bin>& bins() const { return bins_; }
  static constexpr std::size_t most_bins = 2048;

 private:
  void merge_neighbours();

  double bin_s_;
  std::vector<Bin> bins_;
};

}  // namespace enfilade
