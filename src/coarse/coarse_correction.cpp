#include "coarse/coarse_correction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.hpp"

namespace enfilade {

namespace {

/// Clusters come by cell: runs of them, cut into equal shares so that large cells have several
/// unknowns.
CoarseUnknowns shared_unknowns(std::span<const Cluster> clusters, std::size_t most) {
  CoarseUnknowns unknowns{std::vector<std::uint32_t>(clusters.size()),
                          std::vector<std::uint32_t>(clusters.size(), 1), 1};
  const std::size_t share = (clusters.size() + most - 1) / most;
  std::size_t in_group = 0;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const bool other_cell =
        i > 0 && clusters[i].cell != clusters[i - 1].cell && 2 * in_group >= share;
    if (in_group >= share || other_cell) {
      ++unknowns.count;
      in_group = 0;
    }
    unknowns.first[i] = static_cast<std::uint32_t>(unknowns.count - 1);
    ++in_group;
  }
  return unknowns;
}

}  // namespace

std::span<const double> CoarseUnknowns::of(ClusterId cluster, std::span<const double> numbers,
                                           std::size_t bands) const {
  const std::size_t begin = first[cluster.index()] * bands,
                    size = aggregates[cluster.index()] * bands;
  ENFILADE_CHECK(begin + size <= numbers.size(), std::to_string(begin));
  return numbers.subspan(begin, size);
}

bool CoarseUnknowns::complete(std::size_t clusters, std::size_t numbers) {
  if (first.size() != clusters || aggregates.size() != clusters) return false;
  count = 0;
  for (std::size_t i = 0; i < clusters; ++i) {
    const bool shares = i > 0 && aggregates[i] == 1 && first[i] + 1 == count;
    if (aggregates[i] < 1 || !(shares || first[i] == count)) return false;
    count = std::size_t{first[i]} + aggregates[i];
  }
  return count > 0 && numbers % count == 0;
}

CoarseUnknowns coarse_unknowns(std::span<const Cluster> clusters, std::size_t least,
                               std::size_t most) {
  if (clusters.size() > most) return shared_unknowns(clusters, most);
  double area_m2 = 0.0;
  for (const Cluster& cluster : clusters) area_m2 += cluster.area_m2;
  const double more =
      area_m2 > 0.0 && clusters.size() < least ? static_cast<double>(least - clusters.size()) : 0.0;
  CoarseUnknowns unknowns;
  for (const Cluster& cluster : clusters) {
    unknowns.first.push_back(static_cast<std::uint32_t>(unknowns.count));
    unknowns.aggregates.push_back(
        1 + static_cast<std::uint32_t>(more > 0.0 ? more * cluster.area_m2 / area_m2 : 0.0));
    unknowns.count += unknowns.aggregates.back();
  }
  return unknowns;
}

void for_each_coupling(
    ClusterId receiver, const CoarseRow& row, const CoarseUnknowns& unknowns,
    const std::function<void(std::uint32_t, std::uint32_t, std::span<const double>, bool)>& take) {
  const std::size_t first = unknowns.first[receiver.index()];
  for (const CoarseRow::Entry& entry : row.entries) {
    // Each receiving aggregate has a run of numbers, and all bands of each shooting aggregate one
    // of those.
    const std::size_t shooting = unknowns.first[entry.shooter.index()];
    const std::size_t run = entry.flow.size() / row.aggregates,
                      bands = row.after.size() / row.aggregates;
    for (std::size_t i = 0; i < entry.flow.size(); i += bands) {
      const std::span flow = std::span(entry.flow).subspan(i, bands);
      if (std::all_of(flow.begin(), flow.end(), [](double f) { return f == 0.0; })) continue;
      take(static_cast<std::uint32_t>(first + i / run),
           static_cast<std::uint32_t>(shooting + i % run / bands), flow, entry.stale);
    }
  }
}

CoarseSystem::CoarseSystem(std::size_t unknowns, std::size_t bands)
    : unknowns_(unknowns),
      bands_(bands),
      before_(unknowns * bands, 0.0),
      after_(unknowns * bands, 0.0),
      absorbed_(unknowns * bands, 0.0),
      escaping_(unknowns * bands, 0.0),
      rows_(unknowns) {}

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

void CoarseSystem::add(ClusterId receiver, const CoarseRow& row, const CoarseUnknowns& unknowns) {
  const std::size_t first = unknowns.first[receiver.index()] * bands_;
  for (std::size_t i = 0; i < row.after.size(); ++i) {
    before_[first + i] += row.before[i];
    after_[first + i] += row.after[i];
    absorbed_[first + i] += row.absorbed[i];
    escaping_[first + i] += row.escaping[i];
  }
  for_each_coupling(
      receiver, row, unknowns,
      [&](std::uint32_t to, std::uint32_t from, std::span<const double> flow, bool stale) {
        Coupling& c = coupling(to, from);
        std::vector<double>& sum = stale ? c.stale : c.fresh;
        for (std::size_t b = 0; b < bands_; ++b) sum[b] += flow[b];
      });
}

void CoarseSystem::merge(const CoarseSystem& other) {
  ENFILADE_CHECK(other.unknowns_ == unknowns_ && other.bands_ == bands_,
                 std::to_string(other.unknowns_));
  for (std::size_t i = 0; i < after_.size(); ++i) {
    before_[i] += other.before_[i];
    after_[i] += other.after_[i];
    absorbed_[i] += other.absorbed_[i];
    escaping_[i] += other.escaping_[i];
  }
  for (std::size_t g = 0; g < unknowns_; ++g) {
    for (const Coupling& c : other.rows_[g]) {
      Coupling& to = coupling(g, c.column);
      for (std::size_t b = 0; b < bands_; ++b) {
        to.fresh[b] += c.fresh[b];
        to.stale[b] += c.stale[b];
      }
    }
  }
}

std::vector<double> CoarseSystem::solve(const CoarseUnknowns& unknowns) const {
  std::vector<double> changes(unknowns_ * bands_, 0.0);
  for (std::size_t band = 0; band < bands_; ++band) {
    const std::vector<double> x = solve_band(unknowns, band);
    for (std::size_t i = 0; i < unknowns_; ++i) changes[i * bands_ + band] = x[i];
  }
  return changes;
}

/// How a link's light is shared out between the aggregates of its shooter is a guess, but what
/// leaves the cluster is known: each aggregate gives the share of that which it reflects and which
/// does not escape. And no unknown gives more than that, whatever rounding and the links' errors
/// say.
std::vector<CoarseSystem::Column> CoarseSystem::columns(const CoarseUnknowns& unknowns,
                                                        std::size_t band) const {
  std::vector<Column> columns(unknowns_);
  std::vector<double> fresh(unknowns_, 0.0), stale(unknowns_, 0.0);
  for (const auto& row : rows_) {
    for (const Coupling& c : row) {
      fresh[c.column] += c.fresh[band];
      stale[c.column] += c.stale[band];
    }
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
    double all = 0.0, then = 0.0;  // aggregates' light is read stale alone (IterationMethod)
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
    const double most = std::min(gives(j), 0.9999 * after_[j * bands_ + band]);
    if (leaves > most) {
      column.fresh *= most / leaves;
      column.stale *= most / leaves;
    }
  }
  return columns;
}

/// BiCGSTAB (van der Vorst 1992) for the power that is missing, y = P (z - 1):
/// y_c - sum f'_cd / P_d y_d = sum (f'_cd - f_cd).
/// No column sums to more than is reflected, so that all of y is bounded by what changed, however
/// little light an unknown has; in z itself, one in the dark would drown the others.
std::vector<double> CoarseSystem::solve_band(const CoarseUnknowns& unknowns,
                                             std::size_t band) const {
  const std::size_t n = unknowns_;
  const std::vector<Column> columns = this->columns(unknowns, band);
  const auto flow = [&](const Coupling& c) {
    const Column& from = columns[c.column];
    return from.fresh * c.fresh[band] + from.growth * from.stale * c.stale[band];
  };
  const auto power = [&](std::size_t i) { return after_[i * bands_ + band]; };
  const auto apply = [&](const std::vector<double>& x) {
    std::vector<double> y(x);
    for (std::size_t i = 0; i < n; ++i) {
      for (const Coupling& c : rows_[i]) {
        if (power(c.column) > 0.0) y[i] -= flow(c) / power(c.column) * x[c.column];
      }
    }
    return y;
  };
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  std::vector<double> r(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (power(i) <= 0.0) continue;
    for (const Coupling& c : rows_[i]) {
      const Column& from = columns[c.column];
      r[i] += from.stale * (from.growth - 1.0) * c.stale[band];
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
  for (std::size_t i = 0; i < n; ++i) {  // light is never negative
    x[i] = power(i) > 0.0 ? std::max(x[i] / power(i), -1.0) : 0.0;
  }
  return x;
}

double CoarseSystem::power(std::span<const double> changes) const {
  double worst = 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    double sum = 0.0;
    for (std::size_t g = 0; g < unknowns_; ++g) {
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
  std::vector<double> numbers{static_cast<double>(unknowns_), static_cast<double>(bands_)};
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
    take(*power, system.unknowns_ * system.bands_);
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
