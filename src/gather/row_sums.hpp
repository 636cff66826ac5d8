// Sums of rows of form factors before their closure: what the closure hides.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace enfilade {

/// Row sums over their targets (the enclosed shares), weighted by area: 1 where no link's factor is
/// wrong and none is missing. Plain sums, so that those of clusters and ranks add up.
struct RowSums {
  double deficit_m2 = 0.0;  ///< area * |enclosed share - row sum|
  double closed_m2 = 0.0;   ///< area of the leaves in all sums: those whose rows have a target
  double ratio_m2 = 0.0;    ///< area * row sum / enclosed share
  /// Area by ratio, in cells that are finest near 1 (place()); empty where nothing was added.
  std::vector<double> area_by_ratio;

  /// Half of the cells lie on either side of 1. They are 2e-4 wide near 1 and wider in proportion
  /// to |ratio - 1| beyond `finest`.
  static constexpr std::size_t cells = 64;
  static constexpr double finest = 1e-3, farthest = 1.0;

  /// Adds a leaf's row.
  void add(double area_m2, double sum, double target) {
    if (area_by_ratio.empty()) area_by_ratio.resize(cells, 0.0);
    deficit_m2 += area_m2 * std::abs(target - sum);
    closed_m2 += area_m2;
    ratio_m2 += area_m2 * sum / target;
    area_by_ratio[cell_of(sum / target)] += area_m2;
  }

  double mean_deficit() const { return closed_m2 > 0.0 ? deficit_m2 / closed_m2 : 0.0; }
  double mean_ratio() const { return closed_m2 > 0.0 ? ratio_m2 / closed_m2 : 0.0; }
  /// Returns the ratio that rows with the share `p` of the area lie below, to within a cell.
  double percentile(double p) const {
    double whole = 0.0, below = 0.0;
    for (const double m2 : area_by_ratio) whole += m2;
    for (std::size_t k = 0; k < area_by_ratio.size(); ++k) {
      const double here = area_by_ratio[k];
      if (here > 0.0 && below + here >= p * whole)
        return ratio_at(static_cast<double>(k) + std::clamp((p * whole - below) / here, 0.0, 1.0));
      below += here;
    }
    return 0.0;
  }

 private:
  static std::size_t cell_of(double ratio) {
    const double place = std::asinh((ratio - 1.0) / finest) / std::asinh(farthest / finest);
    return static_cast<std::size_t>(
        std::clamp(0.5 * cells * (1.0 + place), 0.0, static_cast<double>(cells - 1)));
  }
  static double ratio_at(double cell) {
    return 1.0 + finest * std::sinh((2.0 * cell / cells - 1.0) * std::asinh(farthest / finest));
  }
};

}  // namespace enfilade
