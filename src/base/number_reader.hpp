// Reads the numbers of a record one by one.
#pragma once

#include <cstdint>
#include <span>

#include "base/error.hpp"

namespace enfilade {

class NumberReader {
 public:
  explicit NumberReader(std::span<const double> numbers) : numbers_(numbers) {}

  /// Returns the next number. Throws RunError where none is left.
  double next() {
    if (numbers_.empty())
      throw RunError(
          "the record of an iteration is damaged, or of another version of enfilade; solve again "
          "without --resume");
    const double value = numbers_.front();
    numbers_ = numbers_.subspan(1);
    return value;
  }
  std::uint64_t next_count() { return static_cast<std::uint64_t>(next()); }
  /// Returns the numbers that have not been read.
  std::span<const double> rest() const { return numbers_; }

 private:
  std::span<const double> numbers_;
};

}  // namespace enfilade
