// The tests of hypotheses that other tests rely on: they see a density that is 5% wrong, and raise
// false alarms as often as they say.
#include "unit/statistics.hpp"

#include "base/random.hpp"

namespace enfilade::testing {
namespace {

/// Counts of n draws from cells of equal width, the first half of which is `more` heavier.
std::vector<double> draw(Random& random, int n, std::size_t cells, double more) {
  const double heavy = (1.0 + more) / (2.0 + more);
  std::vector<double> counts(cells, 0.0);
  for (int i = 0; i < n; ++i) {
    const std::size_t half = random.uniform() < heavy ? 0 : cells / 2;
    ++counts[half + random.below(cells / 2)];
  }
  return counts;
}

TEST(Statistics, SidakCorrectsForTheNumberOfTests) {
  EXPECT_DOUBLE_EQ(sidak(1), significance);
  EXPECT_NEAR(1.0 - std::pow(1.0 - sidak(100), 100), significance, 1e-12);
}

TEST(Statistics, PValuesAreTheTabulatedOnes) {
  Samples samples;  // mean 3, standard error sqrt(2.5 / 5)
  for (const double x : {1.0, 2.0, 3.0, 4.0, 5.0}) samples.add(x);
  EXPECT_DOUBLE_EQ(samples.variance(), 2.5);
  // Student's t with 4 degrees of freedom: 2.776 at 5%.
  EXPECT_NEAR(p_of_mean(samples, 3.0 + 2.776445 * std::sqrt(0.5)), 0.05, 1e-6);
  // Chi-square with 3 degrees of freedom: 7.815 at 5%.
  const double off = std::sqrt(7.814728 * 100.0 / 4.0);
  EXPECT_NEAR(
      p_of_counts(std::vector{100 + off, 100 - off, 100 + off, 100 - off}, std::vector(4, 100.0)),
      0.05, 1e-6);
}

TEST(Statistics, ADensityThatIs5PercentWrongIsSeen) {
  Random random(1);
  const std::vector<double> uniform(64, 1.0 / 64.0);
  int seen = 0, alarms = 0;
  for (int trial = 0; trial < 20; ++trial) {
    seen += are_distributed(draw(random, 200000, 64, 0.05), uniform, 20) ? 0 : 1;
    alarms += are_distributed(draw(random, 200000, 64, 0.0), uniform, 20) ? 0 : 1;
  }
  EXPECT_EQ(seen, 20);
  EXPECT_EQ(alarms, 0);
}

TEST(Statistics, AMeanThatIs5PercentWrongIsSeen) {
  Random random(2);
  Samples samples;  // of relative deviation 1 / sqrt(3)
  for (int i = 0; i < 10000; ++i) samples.add(2.0 * random.uniform());
  EXPECT_TRUE(has_mean(samples, 1.0));
  EXPECT_FALSE(has_mean(samples, 1.05, 50));
  EXPECT_FALSE(has_mean(samples, 0.95, 50));
}

/// Of 4000 tests at 1%, 40 are expected to raise a false alarm: Poisson's 99.9% interval.
TEST(Statistics, FalseAlarmsAreAsManyAsStated) {
  Random random(3);
  const std::vector<double> uniform(16, 1.0 / 16.0);
  int of_counts = 0, of_means = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    of_counts += are_distributed(draw(random, 400, 16, 0.0), uniform) ? 0 : 1;
    Samples samples;
    for (int i = 0; i < 100; ++i) samples.add(random.uniform());
    of_means += has_mean(samples, 0.5) ? 0 : 1;
  }
  EXPECT_GE(of_counts, 21);
  EXPECT_LE(of_counts, 62);
  EXPECT_GE(of_means, 21);
  EXPECT_LE(of_means, 62);
}

TEST(Statistics, SmallCellsArePooledAndImpossibleOnesSeen) {
  EXPECT_EQ(p_of_counts(std::vector{50.0, 49.0, 1.0}, std::vector{50.0, 50.0, 0.0}), 0.0);
  EXPECT_GT(p_of_counts(std::vector{50.0, 50.0, 0.0, 3.0}, std::vector{48.0, 48.0, 3.5, 3.5}), 0.2);
  EXPECT_FALSE(are_distributed(std::vector{3.0}, std::vector{1.0}));
}

}  // namespace
}  // namespace enfilade::testing
