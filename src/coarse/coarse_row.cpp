#include "coarse/coarse_row.hpp"

#include <algorithm>

namespace enfilade {

void for_each_coupling(
    ClusterId receiver, const CoarseRow& row, const CoarseUnknowns& unknowns,
    const std::function<void(std::uint32_t, std::uint32_t, std::span<const double>, bool)>& take) {
  const std::size_t first = unknowns.first[receiver.index()];
  const std::size_t bands = row.after.size() / row.aggregates;
  for (const CoarseRow::Entry& entry : row.entries) {
    // Each receiving aggregate has a run of numbers, and all bands of each shooting aggregate one
    // of those.
    const std::size_t shooting = unknowns.first[entry.shooter.index()];
    const std::size_t run = entry.flow.size() / row.aggregates;
    for (std::size_t i = 0; i < entry.flow.size(); i += bands) {
      const std::span flow = std::span(entry.flow).subspan(i, bands);
      if (std::all_of(flow.begin(), flow.end(), [](double f) { return f == 0.0; })) continue;
      take(static_cast<std::uint32_t>(first + i / run),
           static_cast<std::uint32_t>(shooting + i % run / bands), flow, entry.stale);
    }
  }
  for (std::size_t i = 0; i * bands < row.far.flows.size(); ++i) {
    const std::span flow = std::span(row.far.flows).subspan(i * bands, bands);
    if (std::all_of(flow.begin(), flow.end(), [](double f) { return f == 0.0; })) continue;
    take(static_cast<std::uint32_t>(first + i % row.aggregates),
         row.far.columns[i / row.aggregates], flow, true);
  }
}

}  // namespace enfilade
