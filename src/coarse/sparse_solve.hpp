// Sparse linear systems, by Eigen.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace enfilade {

/// A coefficient of a sparse matrix; those of one place add up.
struct MatrixEntry {
  std::uint32_t row, column;
  double value;
};

/// Solves A x = right for the square matrix A of `entries`. Returns nothing where A is singular,
/// where a number is not finite, and where the residual |A x - right| exceeds 1e-8 |right|.
std::optional<std::vector<double>> solve_sparse(std::span<const MatrixEntry> entries,
                                                std::span<const double> right);

}  // namespace enfilade
