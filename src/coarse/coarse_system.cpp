#include "coarse/coarse_system.hpp"

#include <algorithm>
#include <bit>
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

std::span<double> CoarseSystem::coupling(std::size_t row, std::uint32_t column) {
  Row& r = rows_[row];
  const std::size_t place = r.place_of(column);
  r.flows.resize(2 * bands_ * r.columns.size(), 0.0);
  return std::span(r.flows).subspan(2 * bands_ * place, 2 * bands_);
}

/// The slot that holds the column, or the empty one where it belongs.
std::uint32_t& CoarseSystem::Row::slot_of(std::uint32_t column) {
  // Fibonacci hashing (Knuth, The Art of Computer Programming 3, 6.4): neighbours lie apart.
  const std::size_t last = slots.size() - 1;
  std::size_t at =
      column * std::uint64_t{11400714819323198485u} >> (64 - std::countr_zero(slots.size()));
  while (slots[at] != 0 && columns[slots[at] - 1] != column) at = (at + 1) & last;
  return slots[at];
}

std::size_t CoarseSystem::Row::place_of(std::uint32_t column) {
  if (2 * columns.size() >= slots.size()) {
    slots.assign(std::bit_ceil(std::max<std::size_t>(8, 4 * columns.size())), 0);
    for (std::size_t i = 0; i < columns.size(); ++i)
      slot_of(columns[i]) = static_cast<std::uint32_t>(i + 1);
  }
  std::uint32_t& slot = slot_of(column);
  if (slot == 0) {
    columns.push_back(column);
    slot = static_cast<std::uint32_t>(columns.size());
  }
  return slot - 1;
}

void CoarseSystem::clear() {
  for (std::vector<double>* power : {&before_, &after_, &absorbed_, &escaping_})
    std::fill(power->begin(), power->end(), 0.0);
  for (Row& row : rows_) {
    row.columns.clear();
    row.flows.clear();
    std::fill(row.slots.begin(), row.slots.end(), 0);
  }
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
        const std::span<double> sum = coupling(to, from).subspan(stale ? bands_ : 0);
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
    for_each_of(other.rows_[g], [&](const Coupling& c) {
      const std::span<double> to = coupling(g, c.column);
      for (std::size_t b = 0; b < bands_; ++b) {
        to[b] += c.fresh[b];
        to[bands_ + b] += c.stale[b];
      }
    });
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
  std::size_t size = numbers.size();
  for (const Row& row : rows_) size += 1 + row.columns.size() + row.flows.size();
  numbers.reserve(size);
  for (const Row& row : rows_) {
    numbers.push_back(static_cast<double>(row.flows.size() / (2 * bands_)));
    for_each_of(row, [&numbers](const Coupling& c) {
      numbers.push_back(c.column);
      numbers.insert(numbers.end(), c.fresh.begin(), c.fresh.end());
      numbers.insert(numbers.end(), c.stale.begin(), c.stale.end());
    });
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
  for (Row& row : system.rows_) {
    take(head, 1);
    const auto couplings = static_cast<std::size_t>(head[0]);
    const std::size_t width = 1 + 2 * system.bands_;
    ENFILADE_CHECK(at + couplings * width <= numbers.size(), std::to_string(at));
    row.columns.reserve(couplings);
    row.flows.reserve(couplings * (width - 1));
    for (std::size_t i = 0; i < couplings; ++i, at += width) {
      const auto coupling = numbers.subspan(at, width);
      row.columns.push_back(static_cast<std::uint32_t>(coupling[0]));
      row.flows.insert(row.flows.end(), coupling.begin() + 1, coupling.end());
    }
  }
  return system;
}

}  // namespace enfilade
