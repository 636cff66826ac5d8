// Tests of hypotheses for what random numbers decide: Student's t-test of a mean and Pearson's
// chi-square test of a distribution. Each test that runs many of them states how many, and the
// significance of each is corrected so that all together raise a false alarm with the probability
// `significance` (Sidak 1967). Seeds are fixed, so that a test that passes once always passes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace enfilade::testing {

/// Probability of a false alarm in all tests of one hypothesis together.
constexpr double significance = 0.01;

/// The significance of each of `tests` independent ones, so that all together have the given one.
inline double sidak(int tests, double all = significance) {
  return -std::expm1(std::log1p(-all) / tests);
}

/// Mean and variance of samples, taken one by one (Welford 1962).
class Samples {
 public:
  void add(double x) {
    ++count_;
    const double before = x - mean_;
    mean_ += before / static_cast<double>(count_);
    squares_ += before * (x - mean_);
  }
  std::size_t count() const { return count_; }
  double mean() const { return mean_; }
  double variance() const { return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0.0; }
  double error_of_mean() const { return std::sqrt(variance() / static_cast<double>(count_)); }

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

/// The probability of a mean at least so far from the expected one. `rounding`: a difference that
/// is none.
inline double p_of_mean(const Samples& samples, double expected, double rounding = 0.0) {
  const double off = std::max(0.0, std::abs(samples.mean() - expected) - rounding);
  if (off == 0.0) return 1.0;
  const double error = samples.error_of_mean();
  if (error == 0.0 || samples.count() < 2) return 0.0;
  const boost::math::students_t t(static_cast<double>(samples.count() - 1));
  return 2.0 * boost::math::cdf(boost::math::complement(t, off / error));
}

/// Two-sided t-test, one of `tests`. To be used as EXPECT_TRUE(has_mean(...)).
inline ::testing::AssertionResult has_mean(const Samples& samples, double expected, int tests = 1,
                                           double rounding = 0.0) {
  const double p = p_of_mean(samples, expected, rounding);
  if (p >= sidak(tests)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "mean " << samples.mean() << " +- " << samples.error_of_mean() << " of "
         << samples.count() << " for " << expected << ", p = " << p;
}

/// The probability of counts at least so far from the expected numbers. Cells of which fewer than 5
/// are expected are pooled. A count where none can be has probability 0.
inline double p_of_counts(std::span<const double> counts, std::span<const double> expected) {
  std::vector<std::size_t> order(counts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  double chi2 = 0.0, pooled = 0.0, pooled_expected = 0.0;
  int cells = 0;
  const auto take = [&](double count, double mean) {
    chi2 += (count - mean) * (count - mean) / mean;
    ++cells;
  };
  for (const std::size_t i : order) {
    if (expected[i] <= 0.0) {
      if (counts[i] > 0.0) return 0.0;
      continue;
    }
    if (expected[i] >= 5.0 && pooled_expected == 0.0) {
      take(counts[i], expected[i]);
      continue;
    }
    pooled += counts[i];
    pooled_expected += expected[i];
    if (pooled_expected >= 5.0) {
      take(pooled, pooled_expected);
      pooled = pooled_expected = 0.0;
    }
  }
  if (cells < 2) return std::numeric_limits<double>::quiet_NaN();  // nothing is tested
  return boost::math::cdf(
      boost::math::complement(boost::math::chi_squared(static_cast<double>(cells - 1)), chi2));
}

/// Chi-square test, one of `tests`, of counts in cells against each cell's probability.
inline ::testing::AssertionResult are_distributed(std::span<const double> counts,
                                                  std::span<const double> probability,
                                                  int tests = 1) {
  const double n = std::accumulate(counts.begin(), counts.end(), 0.0);
  const double whole = std::accumulate(probability.begin(), probability.end(), 0.0);
  std::vector<double> expected;
  for (const double p : probability) expected.push_back(n * p);
  const double p = p_of_counts(counts, expected);
  if (std::abs(whole - 1.0) <= 1e-6 && p >= sidak(tests)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << n << " samples in " << counts.size()
                                       << " cells of probability " << whole << ": p = " << p;
}

/// Counts in a grid of cells over the unit square.
class UnitSquareCounts {
 public:
  explicit UnitSquareCounts(int side)
      : side_(side), counts_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side)) {}
  /// Outside of the square is a failure that no cell shows: it is counted apart.
  void add(double x, double y) {
    const auto cell = [this](double u) { return static_cast<int>(std::floor(u * side_)); };
    const int i = cell(x), j = cell(y);
    if (i < 0 || j < 0 || i >= side_ || j >= side_) {
      ++outside_;
    } else {
      ++counts_[static_cast<std::size_t>(i * side_ + j)];
    }
  }
  ::testing::AssertionResult are_uniform(int tests = 1) const {
    if (outside_ > 0) return ::testing::AssertionFailure() << outside_ << " samples outside";
    const std::vector<double> probability(counts_.size(),
                                          1.0 / static_cast<double>(counts_.size()));
    return are_distributed(counts_, probability, tests);
  }

 private:
  int side_;
  std::vector<double> counts_;
  int outside_ = 0;
};

}  // namespace enfilade::testing
