#include "gather/iteration_figures.hpp"

#include <algorithm>

#include "base/number_reader.hpp"

namespace enfilade {
namespace {

void add_bands(Spectrum& sum, const Spectrum& part) {
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
    if constexpr (is_spectrum<decltype(access)>) {
      add_bands(sum, access(part));
    } else {
      sum = figure.fold == Fold::maximum ? std::max(sum, access(part)) : sum + access(part);
    }
  });
}

FoldedNumbers to_numbers(const IterationFigures& figures) {
  FoldedNumbers numbers;
  for_each_figure([&](const FigureName& figure, auto access) {
    const auto& value = access(figures);
    if constexpr (is_spectrum<decltype(access)>) {
      numbers.sums.insert(numbers.sums.end(), value.begin(), value.end());
    } else {
      auto& list = figure.fold == Fold::maximum ? numbers.maxima : numbers.sums;
      list.push_back(static_cast<double>(value));
    }
  });
  return numbers;
}

IterationFigures figures_from(std::span<const double> maxima, std::span<const double> sums) {
  IterationFigures figures;
  NumberReader largest(maxima), summed(sums);
  for_each_number([&](const FigureName& figure, auto access) {
    auto& value = access(figures);
    const double number = figure.fold == Fold::maximum ? largest.next() : summed.next();
    value = static_cast<std::remove_reference_t<decltype(value)>>(number);
  });
  const std::size_t bands = summed.rest().size() / count_spectra();
  for_each_spectrum([&](const FigureName&, auto access) {
    for (std::size_t b = 0; b < bands; ++b) access(figures).push_back(summed.next());
  });
  return figures;
}

}  // namespace enfilade
