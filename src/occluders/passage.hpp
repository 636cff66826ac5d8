// What passes the panes between two points.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace enfilade {

/// The share of the light that passes from one point to another.
struct Passage {
  double share = 1.0;  ///< of the band of each pane that passes most; 0 where a wall stands
  /// Per band, relative to `share`; empty: all bands alike. Bands beyond these (shares of the
  /// light) are theirs again.
  std::vector<double> tint;

  double band(std::size_t b) const { return tint.empty() ? share : share * tint[b % tint.size()]; }
};

/// The mean tint of light that comes over several ways.
class TintSum {
 public:
  /// `light`: what would come if no pane stood between, in any unit.
  void add(double light, const Passage& passage) {
    const double passed = light * passage.share;
    all_ += passed;
    if (passage.tint.empty() && tinted_.empty()) return;
    if (tinted_.empty()) tinted_.assign(passage.tint.size(), all_ - passed);
    for (std::size_t b = 0; b < tinted_.size(); ++b)
      tinted_[b] += passed * (passage.tint.empty() ? 1.0 : passage.tint[b]);
  }
  void add(const TintSum& other) {
    if (tinted_.empty() && !other.tinted_.empty()) tinted_.assign(other.tinted_.size(), all_);
    for (std::size_t b = 0; b < tinted_.size(); ++b)
      tinted_[b] += other.tinted_.empty() ? other.all_ : other.tinted_[b];
    all_ += other.all_;
  }
  /// Returns the mean of Passage::tint by the light that passes; empty where all is untinted.
  std::vector<double> mean() const {
    std::vector<double> tint = tinted_;
    for (double& t : tint) t = all_ > 0.0 ? t / all_ : 1.0;
    return tint;
  }

  /// Returns the mean of how much light each of these sums would gain or lose in this one's tint,
  /// in the band where that is most.
  double mean_difference(std::span<const TintSum> sums) const {
    const std::vector<double> tint = mean();
    double most = 0.0;
    for (std::size_t b = 0; b < tint.size(); ++b) {
      double off = 0.0;
      for (const TintSum& s : sums)
        off += std::abs((s.tinted_.empty() ? s.all_ : s.tinted_[b]) - tint[b] * s.all_);
      most = std::max(most, off / static_cast<double>(sums.size()));
    }
    return most;
  }

 private:
  double all_ = 0.0;
  std::vector<double> tinted_;
};

}  // namespace enfilade
