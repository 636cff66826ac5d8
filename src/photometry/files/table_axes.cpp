#include "photometry/files/table_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// The entries to keep, in ascending order.
std::vector<std::size_t> order_of(const std::vector<double>& list, const char* what,
                                  PhotometricReport& report) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < list.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return list[a] < list[b]; });
  if (!std::is_sorted(order.begin(), order.end()))
    report.warn(fmt::format("has {} that do not ascend: put in order", what));
  std::vector<std::size_t> kept;
  for (const std::size_t i : order)
    if (kept.empty() || list[i] > list[kept.back()]) kept.push_back(i);
  if (kept.size() < list.size()) report.warn(fmt::format("has {} twice: the first is taken", what));
  return kept;
}

void take_negative_as_zero(IntensityTable& table, PhotometricReport& report) {
  double negative = 0.0, sum = 0.0;
  for (double& cd : table.candela) {
    (cd < 0.0 ? negative : sum) += std::abs(cd);
    cd = std::max(0.0, cd);
  }
  if (negative <= 0.0) return;
  constexpr double most_share = 0.01;
  if (negative > most_share * sum)
    report.fail("candela", "has intensities below zero", "correct them, or get the file again");
  report.warn("has a few intensities below zero: taken as 0");
}

}  // namespace

void put_in_order(IntensityTable& table, PhotometricReport& report) {
  take_negative_as_zero(table, report);
  const auto planes = order_of(table.planes, "planes", report);
  const auto angles = order_of(table.angles, "angles", report);
  IntensityTable ordered;
  ordered.type = table.type;
  for (const std::size_t p : planes) {
    ordered.planes.push_back(table.planes[p]);
    for (const std::size_t a : angles) ordered.candela.push_back(table.at(p, a));
  }
  for (const std::size_t a : angles) ordered.angles.push_back(table.angles[a]);
  table = std::move(ordered);
}

}  // namespace enfilade
