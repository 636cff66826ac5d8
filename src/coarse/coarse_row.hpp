// One receiving cluster's row of the coarse system.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "coarse/coarse_unknowns.hpp"

namespace enfilade {

/// Filled by gather(). Powers are area times irradiance: the scene's unit times m2.
struct CoarseRow {
  struct Entry {
    ClusterId shooter;
    bool stale = false;        ///< the shooter's light was that of the iteration before
    std::vector<double> flow;  ///< reflected power that arrived: AggregateFlow::take()
  };
  /// What a far shooter's links bring, divided among the unknowns under it. Its light was that of
  /// the iteration before.
  struct Far {
    std::vector<std::uint32_t> columns;  ///< ascending
    std::vector<double> flows;           ///< [(entry * aggregates + receiving) * bands + band]
  };
  std::size_t aggregates = 1;  ///< of the receiving cluster
  // [aggregate * bands + band]
  std::vector<double> before, after;  ///< power that arrives, before and after this gather
  std::vector<double> absorbed;       ///< the absorbed part of the power `after`
  std::vector<double> escaping;       ///< the part that is reflected and leaves the scene
  std::vector<Entry> entries;         ///< by ascending shooter
  Far far;
};

/// Calls take(row, column, flow per band, stale) for each pair of unknowns with a flow between
/// them.
void for_each_coupling(
    ClusterId receiver, const CoarseRow& row, const CoarseUnknowns& unknowns,
    const std::function<void(std::uint32_t, std::uint32_t, std::span<const double>, bool)>& take);

}  // namespace enfilade
