// A coarse correction over clusters, so that the slow, smooth part of the error does not wait for
// light to be gathered from room to room and back, or along a corridor, whatever the number of
// ranks.
//
// Iterative aggregation (Takahashi 1975; Schweitzer 1991): patches that share an unknown keep the
// proportions of their light, which is scaled by one factor z per unknown and band such that every
// power balance holds. With P_c the power that arrives at unknown c, and f_cd the part of it that
// comes from d by reflection:
//   P_c z_c = (P_c - sum_d f_cd) + sum_d f'_cd z_d
// where f' = f P_new / P_old of shooter d if its light was read stale (as it was before this
// iteration's gather), else f' = f. How a shooter's light is divided among its aggregates need only
// be roughly right: z = 1 solves the converged system whatever f is. Patches that no light reaches
// stay dark, and light without a source (left over from a coarser mesh) vanishes at once.
#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "coarse/coarse_row.hpp"
#include "coarse/coarse_unknowns.hpp"

namespace enfilade {

/// The coarse system. Rows may be added on several ranks, and the parts merged.
class CoarseSystem {
 public:
  CoarseSystem(std::size_t unknowns, std::size_t bands);

  /// Makes it as it was at first, but keeps the memory for the next iteration's rows.
  void clear();
  void add(ClusterId receiver, const CoarseRow& row, const CoarseUnknowns& unknowns);
  /// Adds a coupling without flow, which takes its place in to_numbers().
  void couple(std::uint32_t row, std::uint32_t column) { coupling(row, column); }
  void merge(const CoarseSystem& other);
  /// Returns the relative change of the light, z - 1: [unknown * bands + band]. Zero where nothing
  /// is coupled. Returns nothing where a band's system cannot be solved (solve_sparse()). Throws
  /// RunError where a power is not finite.
  std::optional<std::vector<double>> solve(const CoarseUnknowns& unknowns) const;
  /// Returns the sum over unknowns of |change| times power, worst band: the power that the
  /// iteration lacked.
  double power(std::span<const double> changes) const;
  /// Returns per band the power that the changes add to the absorbed power, and to the escaping
  /// power.
  std::vector<double> absorbed(std::span<const double> changes) const {
    return sum(absorbed_, changes);
  }
  std::vector<double> escaping(std::span<const double> changes) const {
    return sum(escaping_, changes);
  }

  /// Returns the system as numbers, for a message.
  std::vector<double> to_numbers() const;
  static CoarseSystem from_numbers(std::span<const double> numbers);

 private:
  /// Power per band that flows from a column.
  struct Coupling {
    std::uint32_t column;
    std::span<const double> fresh, stale;
  };
  /// The couplings of one unknown, in flat arrays: there are hundreds, anew in each iteration.
  struct Row {
    std::vector<std::uint32_t> columns;  ///< of the couplings, as they came
    std::vector<double> flows;  ///< of each coupling the fresh ones per band, then the stale
    /// A hash table with open addressing, at least half empty: places in `columns`, from 1; 0 =
    /// none.
    std::vector<std::uint32_t> slots;

    /// Returns the place of a coupling, which is made where there is none.
    std::size_t place_of(std::uint32_t column);
    std::uint32_t& slot_of(std::uint32_t column);
  };
  /// Returns the fresh flows of a coupling, which the stale ones follow.
  std::span<double> coupling(std::size_t row, std::uint32_t column);
  /// Calls take(Coupling) in ascending order of the columns.
  template <class Take>
  void for_each_of(const Row& row, Take take) const;
  /// What the flows from one shooting unknown are multiplied by.
  struct Column {
    double growth = 1.0;              ///< of its power, since its light was read stale
    double fresh = 1.0, stale = 1.0;  ///< limits on the flows read fresh and stale
  };
  void require_finite() const;
  std::optional<std::vector<double>> solve_band(const CoarseUnknowns& unknowns,
                                                std::size_t band) const;
  std::vector<Column> columns(const CoarseUnknowns& unknowns, std::size_t band) const;
  std::vector<double> sum(std::span<const double> power, std::span<const double> changes) const;

  std::size_t unknowns_, bands_;
  // Power, [unknown * bands + band].
  std::vector<double> before_, after_, absorbed_, escaping_;
  std::vector<Row> rows_;
};

template <class Take>
void CoarseSystem::for_each_of(const Row& row, Take take) const {
  std::vector<std::uint32_t> order(row.columns.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&row](std::uint32_t a, std::uint32_t b) { return row.columns[a] < row.columns[b]; });
  for (const std::uint32_t i : order) {
    const auto flows = std::span(row.flows).subspan(2 * bands_ * i);
    take(Coupling{row.columns[i], flows.first(bands_), flows.subspan(bands_, bands_)});
  }
}

}  // namespace enfilade
