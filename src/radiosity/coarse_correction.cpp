#include "radiosity/coarse_correction.hpp"

#include <algorithm>
#include <cmath>

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
      area_(groups, 0.0),
      change_(groups * bands, 0.0),
      rows_(groups) {}

void CoarseSystem::add(std::uint32_t group, const CoarseRow& row,
                       std::span<const std::uint32_t> group_of_cluster) {
  area_[group] += row.area_m2;
  for (std::size_t b = 0; b < bands_; ++b) change_[group * bands_ + b] += row.change[b];
  for (const CoarseRow::Entry& entry : row.entries) {
    const std::uint32_t column = group_of_cluster[entry.shooter.index()];
    auto at = std::lower_bound(rows_[group].begin(), rows_[group].end(), column,
                               [](const Coupling& c, std::uint32_t k) { return c.column < k; });
    if (at == rows_[group].end() || at->column != column) {
      const std::vector<double> none(bands_, 0.0);
      at = rows_[group].insert(at, {column, none, none});
    }
    for (std::size_t b = 0; b < bands_; ++b) {
      at->all[b] += entry.coupling[b];
      if (entry.stale) at->stale[b] += entry.coupling[b];
    }
  }
}

void CoarseSystem::merge(const CoarseSystem& other) {
  ENFILADE_CHECK(other.groups_ == groups_ && other.bands_ == bands_, std::to_string(other.groups_));
  for (std::size_t g = 0; g < groups_; ++g) {
    area_[g] += other.area_[g];
    for (std::size_t b = 0; b < bands_; ++b)
      change_[g * bands_ + b] += other.change_[g * bands_ + b];
    for (const Coupling& c : other.rows_[g]) {
      auto at = std::lower_bound(rows_[g].begin(), rows_[g].end(), c.column,
                                 [](const Coupling& x, std::uint32_t k) { return x.column < k; });
      if (at == rows_[g].end() || at->column != c.column) {
        rows_[g].insert(at, c);
        continue;
      }
      for (std::size_t b = 0; b < bands_; ++b) {
        at->all[b] += c.all[b];
        at->stale[b] += c.stale[b];
      }
    }
  }
}

/// BiCGSTAB (van der Vorst 1992) with the areas as preconditioner, one band at a time.
std::vector<double> CoarseSystem::solve() const {
  std::vector<double> offsets(groups_ * bands_, 0.0);
  const std::size_t n = groups_;
  for (std::size_t band = 0; band < bands_; ++band) {
    auto area = [&](std::size_t i) { return area_[i] > 0.0 ? area_[i] : 1.0; };
    auto apply = [&](const std::vector<double>& x) {  // (I - K / S) x
      std::vector<double> y(x);
      for (std::size_t i = 0; i < n; ++i) {
        for (const Coupling& c : rows_[i]) y[i] -= c.all[band] * x[c.column] / area(i);
      }
      return y;
    };
    auto dot = [&](const std::vector<double>& a, const std::vector<double>& b) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
      return sum;
    };
    std::vector<double> r(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (const Coupling& c : rows_[i]) {
        r[i] += c.stale[band] * change_[c.column * bands_ + band] / area(c.column) / area(i);
      }
    }
    std::vector<double> x(n, 0.0), p(n, 0.0), v(n, 0.0);
    const std::vector<double> shadow = r;
    const double start = std::sqrt(dot(r, r));
    if (start <= 0.0) continue;
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
    const bool good = std::sqrt(dot(r, r)) <= 0.1 * start;  // else do without
    for (std::size_t i = 0; i < n && good; ++i) offsets[i * bands_ + band] = x[i];
  }
  return offsets;
}

double CoarseSystem::power(std::span<const double> offsets) const {
  double worst = 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    double sum = 0.0;
    for (std::size_t g = 0; g < groups_; ++g) sum += area_[g] * std::abs(offsets[g * bands_ + b]);
    worst = std::max(worst, sum);
  }
  return worst;
}

std::vector<double> CoarseSystem::to_numbers() const {
  std::vector<double> numbers{static_cast<double>(groups_), static_cast<double>(bands_)};
  numbers.insert(numbers.end(), area_.begin(), area_.end());
  numbers.insert(numbers.end(), change_.begin(), change_.end());
  for (const auto& row : rows_) {
    numbers.push_back(static_cast<double>(row.size()));
    for (const Coupling& c : row) {
      numbers.push_back(c.column);
      numbers.insert(numbers.end(), c.all.begin(), c.all.end());
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
  take(system.area_, system.groups_);
  take(system.change_, system.groups_ * system.bands_);
  std::vector<double> head;
  for (auto& row : system.rows_) {
    take(head, 1);
    row.resize(static_cast<std::size_t>(head[0]));
    for (Coupling& c : row) {
      take(head, 1);
      c.column = static_cast<std::uint32_t>(head[0]);
      take(c.all, system.bands_);
      take(c.stale, system.bands_);
    }
  }
  return system;
}

}  // namespace enfilade
