#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.hpp"
#include "coarse/coarse_system.hpp"
#include "coarse/sparse_solve.hpp"

namespace enfilade {
namespace {

/// Share of its power that an unknown gives at most: below 1, so that the matrix is diagonally
/// dominant by columns and not singular, even in a closed scene of white surfaces.
constexpr double most_given = 0.9999;

bool all_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

void CoarseSystem::require_finite() const {
  bool finite =
      all_finite(before_) && all_finite(after_) && all_finite(absorbed_) && all_finite(escaping_);
  for (const Row& row : rows_) finite = finite && all_finite(row.flows);
  if (!finite) {
    throw RunError(
        "coarse correction: the power that arrives at a cluster is not a finite number; solve "
        "again with --no-coarse-correction, or check the scene's exitances and intensities");
  }
}

std::optional<std::vector<double>> CoarseSystem::solve(const CoarseUnknowns& unknowns) const {
  require_finite();
  std::vector<double> changes(unknowns_ * bands_, 0.0);
  for (std::size_t band = 0; band < bands_; ++band) {
    const std::optional<std::vector<double>> x = solve_band(unknowns, band);
    if (!x) return std::nullopt;
    for (std::size_t i = 0; i < unknowns_; ++i) changes[i * bands_ + band] = (*x)[i];
  }
  return changes;
}

/// Limits the flows from each shooting unknown to the power that it reflects and that does not
/// escape, whatever rounding and the links' errors say. Of a cluster with several aggregates,
/// AggregateFlow only estimates which of them the light comes from: the cluster's stale flow is
/// divided among its aggregates by the power that each reflected.
std::vector<CoarseSystem::Column> CoarseSystem::columns(const CoarseUnknowns& unknowns,
                                                        std::size_t band) const {
  std::vector<Column> columns(unknowns_);
  std::vector<double> fresh(unknowns_, 0.0), stale(unknowns_, 0.0);
  for (const Row& row : rows_) {
    for_each_of(row, [&](const Coupling& c) {
      fresh[c.column] += c.fresh[band];
      stale[c.column] += c.stale[band];
    });
  }
  for (std::size_t j = 0; j < unknowns_; ++j) {
    const double before = before_[j * bands_ + band], after = after_[j * bands_ + band];
    if (before > 0.0 && after > 0.0) columns[j].growth = after / before;
  }
  const auto gives = [&](std::size_t j) {
    const std::size_t at = j * bands_ + band;
    return std::max(0.0, after_[at] - absorbed_[at] - escaping_[at]);
  };
  for (std::size_t c = 0; c < unknowns.first.size(); ++c) {
    const std::size_t begin = unknowns.first[c], end = begin + unknowns.aggregates[c];
    if (end - begin < 2) continue;
    double all = 0.0, then = 0.0;  // light of several aggregates is always read stale (Jacobi)
    for (std::size_t j = begin; j < end; ++j) {
      all += stale[j];
      then += gives(j) / columns[j].growth;
    }
    for (std::size_t j = begin; j < end && then > 0.0; ++j) {
      if (stale[j] > 0.0) columns[j].stale = gives(j) / columns[j].growth / then * all / stale[j];
    }
  }
  for (std::size_t j = 0; j < unknowns_; ++j) {
    Column& column = columns[j];
    const double leaves = column.fresh * fresh[j] + column.growth * column.stale * stale[j];
    // Errors of links may leave an unknown with light below zero: it gives nothing.
    const double most = std::max(0.0, std::min(gives(j), most_given * after_[j * bands_ + band]));
    if (leaves > most) {
      column.fresh *= most / leaves;
      column.stale *= most / leaves;
    }
  }
  return columns;
}

/// Solves for the missing power y = P (z - 1):
///   y_c - sum_d f'_cd / P_d y_d = sum_d (f'_cd - f_cd)
/// No column's couplings sum to more than the share that its unknown reflects, so that sum |y| is
/// bounded by the change of the flows, however little light an unknown has. Solved for z itself,
/// the error of an unknown with hardly any light would outweigh the others.
std::optional<std::vector<double>> CoarseSystem::solve_band(const CoarseUnknowns& unknowns,
                                                            std::size_t band) const {
  const std::vector<Column> columns = this->columns(unknowns, band);
  const auto power = [&](std::size_t i) { return after_[i * bands_ + band]; };
  std::vector<MatrixEntry> matrix;
  std::vector<double> missing(unknowns_, 0.0);
  for (std::uint32_t i = 0; i < unknowns_; ++i) {
    matrix.push_back({i, i, 1.0});
    for_each_of(rows_[i], [&](const Coupling& c) {
      const Column& from = columns[c.column];
      const double flow = from.fresh * c.fresh[band] + from.growth * from.stale * c.stale[band];
      if (power(c.column) > 0.0) matrix.push_back({i, c.column, -flow / power(c.column)});
      if (power(i) > 0.0) missing[i] += from.stale * (from.growth - 1.0) * c.stale[band];
    });
  }
  if (std::all_of(missing.begin(), missing.end(), [](double m) { return m == 0.0; }))
    return missing;
  std::optional<std::vector<double>> x = solve_sparse(matrix, missing);
  if (!x) return std::nullopt;
  for (std::size_t i = 0; i < unknowns_; ++i) {  // light is never negative
    (*x)[i] = power(i) > 0.0 ? std::max((*x)[i] / power(i), -1.0) : 0.0;
  }
  return x;
}

}  // namespace enfilade
