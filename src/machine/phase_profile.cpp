#include "machine/phase_profile.hpp"

#include <algorithm>
#include <cmath>

namespace enfilade {

void PhaseProfile::add(Phase phase, double from_s, double to_s) {
  if (!(to_s > from_s)) return;
  while (to_s > bin_s_ * static_cast<double>(most_bins)) merge_neighbours();
  auto bin = static_cast<std::size_t>(from_s / bin_s_);
  for (double at_s = from_s; at_s < to_s; ++bin) {
    const double end_s = std::min(to_s, bin_s_ * static_cast<double>(bin + 1));
    if (bin >= bins_.size()) bins_.resize(bin + 1, Bin{});
    bins_[bin][static_cast<std::size_t>(phase)] += std::max(0.0, end_s - at_s);
    at_s = std::max(at_s, end_s);
    if (end_s == to_s) break;
  }
}

void PhaseProfile::widen(double bin_s) {
  while (bin_s_ < bin_s) merge_neighbours();
}

void PhaseProfile::merge_neighbours() {
  for (std::size_t i = 0; i < bins_.size(); i += 2) {
    Bin sum = bins_[i];
    if (i + 1 < bins_.size()) {
      for (std::size_t p = 0; p < phase_count; ++p) sum[p] += bins_[i + 1][p];
    }
    bins_[i / 2] = sum;
  }
  bins_.resize((bins_.size() + 1) / 2);
  bin_s_ *= 2.0;
}

}  // namespace enfilade
