// What panes change in bounds of the light.
#pragma once

#include <vector>

#include "bounds/iteration/bound_irradiance.hpp"

namespace enfilade {

class BoundPanes {
 public:
  explicit BoundPanes(const BoundScene& scene);

  bool any() const { return !flags_.empty(); }
  /// 1 for each pane; empty where there is none.
  const std::vector<char>& flags() const { return flags_; }
  /// True of a pane that sends no light of its own: it takes no part in the light.
  bool is_dark(std::uint32_t polygon) const { return any() && dark_[polygon] != 0; }
  /// Returns the most that the form factors of a point may sum to, times what passes: 1, and 1 for
  /// each pane that sends light, since what is seen through it counts as well.
  double most_sum() const { return most_sum_; }
  /// Returns the product of all transmittances in one band. Throws InputError where no bound would
  /// follow from it.
  double passed_by_all(std::size_t band) const;

 private:
  const BoundScene& scene_;
  std::vector<char> flags_, dark_;
  double most_sum_ = 1.0;
};

}  // namespace enfilade
