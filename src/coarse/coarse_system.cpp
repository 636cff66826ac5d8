#include "coarse/coarse_system.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace enfilade {

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
