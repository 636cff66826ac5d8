// Lines of equal value over a grid.
#pragma once

#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

/// Values at the middles of a grid's cells, row by row; NaN where there is none.
struct GridField {
  int columns = 0, rows = 0;
  std::vector<double> values;
  double at(int column, int row) const {
    return values[static_cast<std::size_t>(column) +
                  static_cast<std::size_t>(columns) * static_cast<std::size_t>(row)];
  }
  /// Returns the bilinear value at (u, v), in columns and rows, where the four values around are
  /// known; that of the nearest of them where some are not; NaN where that is not known either.
  double between(double u, double v) const;
};

/// Returns 1, 1.5, 2, 3, 5, 7.5, 10, ...: the values of EN 12464-1's scale of illuminance between
/// the field's least and largest value, thinned to at most `most`.
std::vector<double> scale_levels(double lowest, double highest, std::size_t most);

/// Returns lines on which the field has value `level`, as points in columns and rows, by marching
/// squares on the field refined four times, where the four values around are known.
std::vector<std::vector<Vec2>> isolines(const GridField& field, double level);

}  // namespace enfilade
