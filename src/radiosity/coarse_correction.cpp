#include "radiosity/coarse_correction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"

namespace enfilade {

std::vector<std::uint32_t> coarse_groups(std::span<const Cluster> clusters, std::size_t most) {
  std::vector<std::uint32_t> group(clusters.size());
  if (clusters.size() <= most) {
    for (std::size_t i = 0; i < group.size(); ++i) group[i] = static_cast<std::uint32_t>(i);
    return group;
  }
  // Clusters come by cell: runs of them, cut into equal shares so that large cells have several
  // unknowns.
  const std::size_t share = (clusters.size() + most - 1) / most;
  std::uint32_t next = 0;
  std::size_t in_group = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const bool other_cell =
        i > 0 && clusters[i].cell != clusters[i - 1].cell && 2 * in_group >= share;
    if (i > 0 && (in_group >= share || other_cell)) {
      ++next;
      in_group = 0;
    }
    group[i] = next;
    ++in_group;
  }
  return group;
}

CoarseSystem::CoarseSystem(std::size_t groups, std::size_t bands)
    : groups_(groups),
      bands_(bands),
      before_(groups * bands, 0.0),
      after_(groups * bands, 0.0),
      absorbed_(groups * bands, 0.0),
      escaping_(groups * bands, 0.0),
      rows_(groups) {}

CoarseSystem::Coupling& CoarseSystem::coupling(std::size_t row, std::uint32_t column) {
  std::vector<Coupling>& couplings = rows_[row];
  auto at = std::lower_bound(couplings.begin(), couplings.end(), column,
                             [](const Coupling& c, std::uint32_t k) { return c.column < k; });
  if (at == couplings.end() || at->column != column) {
    const std::vector<double> none(bands_, 0.0);
    at = couplings.insert(at, {column, none, none});
  }
  return *at;
}

void CoarseSystem::add(std::uint32_t group, const CoarseRow& row,
                       std::span<const std::uint32_t> group_of_cluster) {
  for (std::size_t b = 0; b < bands_; ++b) {
    before_[group * bands_ + b] += row.before[b];
    after_[group * bands_ + b] += row.after[b];
    absorbed_[group * bands_ + b] += row.absorbed[b];
    escaping_[group * bands_ + b] += row.escaping[b];
  }
  for (const CoarseRow::Entry& entry : row.entries) {
    Coupling& to = coupling(group, group_of_cluster[entry.shooter.index()]);
    std::vector<double>& flow = entry.stale ? to.stale : to.fresh;
    for (std::size_t b = 0; b < bands_; ++b) flow[b] += entry.flow[b];
  }
}

void CoarseSystem::merge(const CoarseSystem& other) {
  ENFILADE_CHECK(other.groups_ == groups_ && other.bands_ == bands_, std::to_string(other.groups_));
  for (std::size_t i = 0; i < after_.size(); ++i) {
    before_[i] += other.before_[i];
    after_[i] += other.after_[i];
    absorbed_[i] += other.absorbed_[i];
    escaping_[i] += other.escaping_[i];
  }
  for (std::size_t g = 0; g < groups_; ++g) {
    for (const Coupling& c : other.rows_[g]) {
      Coupling& to = coupling(g, c.column);
      for (std::size_t b = 0; b < bands_; ++b) {
        to.fresh[b] += c.fresh[b];
        to.stale[b] += c.stale[b];
      }
    }
  }
}

std::vector<double> CoarseSystem::solve() const {
  std::vector<double> changes(groups_ * bands_, 0.0);
  for (std::size_t band = 0; band < bands_; ++band) {
    const std::vector<double> x = solve_band(band);
    for (std::size_t i = 0; i < groups_; ++i) changes[i * bands_ + band] = x[i];
  }
  return changes;
}

/// BiCGSTAB (van der Vorst 1992) with the groups' power as preconditioner, for x = z - 1:
/// P_c x_c - sum f'_cd x_d = sum (f'_cd - f_cd).
std::vector<double> CoarseSystem::solve_band(std::size_t band) const {
  const std::size_t n = groups_;
  // How much the light that was read stale has grown since, and what then leaves each group: never
  // more than arrived there, whatever rounding and the links' errors say.
  std::vector<double> growth(n, 1.0), leaves(n, 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    const double before = before_[j * bands_ + band], after = after_[j * bands_ + band];
    if (before > 0.0 && after > 0.0) growth[j] = after / before;
  }
  const auto flow = [&](const Coupling& c) {
    return c.fresh[band] + growth[c.column] * c.stale[band];
  };
  for (const auto& row : rows_) {
    for (const Coupling& c : row) leaves[c.column] += std::max(0.0, flow(c));
  }
  std::vector<double> share(n, 1.0);
  for (std::size_t j = 0; j < n; ++j) {
    const double most = 0.9999 * std::max(0.0, after_[j * bands_ + band]);
    if (leaves[j] > most) share[j] = most / leaves[j];
  }
  const auto power = [&](std::size_t i) {
    const double p = after_[i * bands_ + band];
    return p > 0.0 ? p : 1.0;
  };
  const auto apply = [&](const std::vector<double>& x) {
    std::vector<double> y(x);
    for (std::size_t i = 0; i < n; ++i) {
      for (const Coupling& c : rows_[i]) {
        y[i] -= share[c.column] * flow(c) * x[c.column] / power(i);
      }
    }
    return y;
  };
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  std::vector<double> r(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (after_[i * bands_ + band] <= 0.0) continue;
    for (const Coupling& c : rows_[i]) {
      r[i] += (growth[c.column] - 1.0) * c.stale[band] / power(i);
    }
  }
  std::vector<double> x(n, 0.0), p(n, 0.0), v(n, 0.0);
  const std::vector<double> shadow = r;
  const double start = std::sqrt(dot(r, r));
  if (start <= 0.0) return x;
  double rho = 1.0, alpha = 1.0, omega = 1.0;
  for (int k = 0; k < 500 && std::sqrt(dot(r, r)) > 1e-6 * start; ++k) {
    const double next = dot(shadow, r);
    if (next == 0.0 || omega == 0.0) break;
    const double beta = next / rho * alpha / omega;
    rho = next;
    for (std::size_t i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
    v = apply(p);
    const double along = dot(shadow, v);
    if (along == 0.0) break;
    alpha = rho / along;
    std::vector<double> s(r);
    for (std::size_t i = 0; i < n; ++i) s[i] -= alpha * v[i];
    const std::vector<double> t = apply(s);
    const double tt = dot(t, t);
    omega = tt > 0.0 ? dot(t, s) / tt : 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      x[i] += alpha * p[i] + omega * s[i];
      r[i] = s[i] - omega * t[i];
    }
  }
  if (std::sqrt(dot(r, r)) > 0.1 * start) return std::vector<double>(n, 0.0);  // do without
  for (double& change : x) change = std::max(change, -1.0);  // light is never negative
  return x;
}

double CoarseSystem::power(std::span<const double> changes) const {
  double worst = 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    double sum = 0.0;
    for (std::size_t g = 0; g < groups_; ++g) {
      sum += std::abs(after_[g * bands_ + b] * changes[g * bands_ + b]);
    }
    worst = std::max(worst, sum);
  }
  return worst;
}

std::vector<double> CoarseSystem::sum(std::span<const double> power,
                                      std::span<const double> changes) const {
  std::vector<double> total(bands_, 0.0);
  for (std::size_t i = 0; i < changes.size(); ++i) total[i % bands_] += power[i] * changes[i];
  return total;
}

std::vector<double> CoarseSystem::to_numbers() const {
  std::vector<double> numbers{static_cast<double>(groups_), static_cast<double>(bands_)};
  for (const std::vector<double>* power : {&before_, &after_, &absorbed_, &escaping_}) {
    numbers.insert(numbers.end(), power->begin(), power->end());
  }
  for (const auto& row : rows_) {
    numbers.push_back(static_cast<double>(row.size()));
    for (const Coupling& c : row) {
      numbers.push_back(c.column);
      numbers.insert(numbers.end(), c.fresh.begin(), c.fresh.end());
      numbers.insert(numbers.end(), c.stale.begin(), c.stale.end());
    }
  }
  return numbers;
}

CoarseSystem CoarseSystem::from_numbers(std::span<const double> numbers) {
  ENFILADE_CHECK(numbers.size() >= 2, std::to_string(numbers.size()));
  CoarseSystem system(static_cast<std::size_t>(numbers[0]), static_cast<std::size_t>(numbers[1]));
  std::size_t at = 2;
  auto take = [&](std::vector<double>& to, std::size_t n) {
    ENFILADE_CHECK(at + n <= numbers.size(), std::to_string(at));
    to.assign(numbers.begin() + static_cast<std::ptrdiff_t>(at),
              numbers.begin() + static_cast<std::ptrdiff_t>(at + n));
    at += n;
  };
  for (std::vector<double>* power :
       {&system.before_, &system.after_, &system.absorbed_, &system.escaping_}) {
    take(*power, system.groups_ * system.bands_);
  }
  std::vector<double> head;
  for (auto& row : system.rows_) {
    take(head, 1);
    row.resize(static_cast<std::size_t>(head[0]));
    for (Coupling& c : row) {
      take(head, 1);
      c.column = static_cast<std::uint32_t>(head[0]);
      take(c.fresh, system.bands_);
      take(c.stale, system.bands_);
    }
  }
  return system;
}

}  // namespace enfilade
