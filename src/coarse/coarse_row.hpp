// One receiving cluster's row of the coarse system.
#pragma once

#include <algorithm>
#include <cstdint>
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
/// them. A template: in a large building each of its clusters has hundreds of pairs.
template <class Take>
void for_each_coupling(ClusterId receiver, const CoarseRow& row, const CoarseUnknowns& unknowns,
                       Take take) {
  const std::size_t first = unknowns.first[receiver.index()];
  const std::size_t bands = row.after.size() / row.aggregates;
  const auto none = [](std::span<const double> flow) {
    return std::all_of(flow.begin(), flow.end(), [](double f) { return f == 0.0; });
  };
  for (const CoarseRow::Entry& entry : row.entries) {
    // Each receiving aggregate has a run of numbers, and all bands of each shooting aggregate one
    // of those.
    const std::size_t shooting = unknowns.first[entry.shooter.index()];
    const std::size_t run = entry.flow.size() / row.aggregates;
    for (std::size_t i = 0; i < entry.flow.size(); i += bands) {
      const std::span<const double> flow = std::span(entry.flow).subspan(i, bands);
      if (none(flow)) continue;
      take(static_cast<std::uint32_t>(first + i / run),
           static_cast<std::uint32_t>(shooting + i % run / bands), flow, entry.stale);
    }
  }
  for (std::size_t i = 0; i * bands < row.far.flows.size(); ++i) {
    const std::span<const double> flow = std::span(row.far.flows).subspan(i * bands, bands);
    if (none(flow)) continue;
    take(static_cast<std::uint32_t>(first + i % row.aggregates),
         row.far.columns[i / row.aggregates], flow, true);
  }
}

}  // namespace enfilade
