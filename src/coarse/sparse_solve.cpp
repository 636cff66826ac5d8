#include "coarse/sparse_solve.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>

namespace enfilade {
namespace {

/// Relative to the right-hand side. The LU factors of coarse matrices, which are diagonally
/// dominant by columns, leave less than 1e-11; more than this is a breakdown.
constexpr double largest_residual = 1e-8;

}  // namespace

std::optional<std::vector<double>> solve_sparse(std::span<const MatrixEntry> entries,
                                                std::span<const double> right) {
  const bool finite =
      std::all_of(entries.begin(), entries.end(),
                  [](const MatrixEntry& entry) { return std::isfinite(entry.value); }) &&
      std::all_of(right.begin(), right.end(), [](double value) { return std::isfinite(value); });
  if (!finite) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(right.size());
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size());
  for (const MatrixEntry& entry : entries) {
    triplets.emplace_back(static_cast<int>(entry.row), static_cast<int>(entry.column), entry.value);
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::Map<const Eigen::VectorXd> b(right.data(), n);
  Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
  if (lu.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd x = lu.solve(b);
  if (lu.info() != Eigen::Success || !((matrix * x - b).norm() <= largest_residual * b.norm()))
    return std::nullopt;
  return std::vector<double>(x.begin(), x.end());
}

}  // namespace enfilade
