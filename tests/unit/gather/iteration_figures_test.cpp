#include "gather/iteration_figures.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

/// Figures of which no two are alike, from `first` on.
IterationFigures all_different(double first) {
  IterationFigures figures;
  double next = first;
  for_each_number([&](const FigureName&, auto access) {
    auto& value = access(figures);
    value = static_cast<std::remove_reference_t<decltype(value)>>(next);
    next += 1.0;
  });
  for_each_spectrum([&](const FigureName&, auto access) {
    access(figures) = {next, next + 0.5};
    next += 1.0;
  });
  figures.rows.area_by_ratio.assign(RowSums::cells, next);
  return figures;
}

/// What the token does with the figures of ranks: sums, but the largest change of all.
TEST(IterationFigures, AddUpAndKeepTheLargestChange) {
  for (const auto& [a, b] : {std::pair{1.0, 100.0}, {100.0, 1.0}}) {
    const IterationFigures one = all_different(a), other = all_different(b);
    IterationFigures both = one;
    add(both, other);
    EXPECT_EQ(both.max_change, 100.0);
    for_each_figure([&](const FigureName& figure, auto access) {
      if constexpr (is_list<decltype(access)>) {
        ASSERT_EQ(access(both).size(), access(one).size()) << figure.name;
        for (std::size_t i = 0; i < access(both).size(); ++i)
          EXPECT_EQ(access(both)[i], access(one)[i] + access(other)[i]) << figure.name;
      } else if (figure.fold == Fold::sum) {
        EXPECT_EQ(access(both), access(one) + access(other)) << figure.name;
      }
    });
  }
}

TEST(IterationFigures, ComeBackFromTheirNumbers) {
  for (const IterationFigures& figures : {all_different(3.0), IterationFigures{}}) {
    const FoldedNumbers numbers = to_numbers(figures);
    IterationFigures back = figures_from(numbers.maxima, numbers.sums);
    for_each_figure([&](const FigureName& figure, auto access) {
      if constexpr (!is_list<decltype(access)>) {
        EXPECT_EQ(access(back), access(figures)) << figure.name;
      }
    });
    EXPECT_EQ(back.error_samples.noise, figures.error_samples.noise);
    EXPECT_EQ(back.rows.closed_m2, figures.rows.closed_m2);
    EXPECT_EQ(back.rows.area_by_ratio.size(), RowSums::cells);
  }
  const FoldedNumbers numbers = to_numbers(all_different(3.0));
  const std::vector<double> few(numbers.sums.begin(), numbers.sums.begin() + 5);
  EXPECT_THROW(figures_from(numbers.maxima, few), RunError);
}

}  // namespace
}  // namespace enfilade
