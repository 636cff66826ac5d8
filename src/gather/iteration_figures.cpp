#include "gather/iteration_figures.hpp"

#include <algorithm>

#include "base/number_reader.hpp"

namespace enfilade {
namespace {

void add_list(Spectrum& sum, const Spectrum& part) {
  if (sum.size() < part.size()) sum.resize(part.size(), 0.0);
  for (std::size_t b = 0; b < part.size(); ++b) sum[b] += part[b];
}

std::size_t count_spectra() {
  std::size_t count = 0;
  for_each_spectrum([&count](const FigureName&, auto) { ++count; });
  return count;
}

}  // namespace

void add(IterationFigures& figures, const IterationFigures& part) {
  for_each_figure([&](const FigureName& figure, auto access) {
    auto& sum = access(figures);
    if constexpr (is_list<decltype(access)>) {
      add_list(sum, access(part));
    } else {
      sum = figure.fold == Fold::maximum ? std::max(sum, access(part)) : sum + access(part);
    }
  });
}

FoldedNumbers to_numbers(const IterationFigures& figures) {
  FoldedNumbers numbers;
  for_each_figure([&](const FigureName& figure, auto access) {
    const auto& value = access(figures);
    if constexpr (is_list<decltype(access)>) {
      numbers.sums.insert(numbers.sums.end(), value.begin(), value.end());
    } else {
      auto& list = figure.fold == Fold::maximum ? numbers.maxima : numbers.sums;
      list.push_back(static_cast<double>(value));
    }
  });
  // An empty histogram is as long as any: figures that are sent are all of one length.
  for_each_histogram([&](const FigureName&, auto access) {
    if (access(figures).empty()) numbers.sums.resize(numbers.sums.size() + RowSums::cells, 0.0);
  });
  return numbers;
}

IterationFigures figures_from(std::span<const double> maxima, std::span<const double> sums) {
  IterationFigures figures;
  NumberReader largest(maxima), summed(sums);
  for_each_number([&](const FigureName& figure, auto access) {
    auto& value = access(figures);
    NumberReader& numbers = figure.fold == Fold::maximum ? largest : summed;
    if constexpr (std::is_integral_v<std::remove_reference_t<decltype(value)>>) {
      value = numbers.next_count();
    } else {
      value = numbers.next();
    }
  });
  const std::size_t rest = summed.rest().size();
  const std::size_t bands = rest > RowSums::cells ? (rest - RowSums::cells) / count_spectra() : 0;
  for_each_spectrum([&](const FigureName&, auto access) {
    for (std::size_t b = 0; b < bands; ++b) access(figures).push_back(summed.next());
  });
  for_each_histogram([&](const FigureName&, auto access) {
    for (std::size_t k = 0; k < RowSums::cells; ++k) access(figures).push_back(summed.next());
  });
  return figures;
}

}  // namespace enfilade
