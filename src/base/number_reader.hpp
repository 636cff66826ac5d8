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
    if (numbers_.empty()) fail();
    const double value = numbers_.front();
    numbers_ = numbers_.subspan(1);
    return value;
  }
  /// The same for a number that counts something.
  std::uint64_t next_count() {
    const double value = next();
    if (!(value >= 0.0 && value <= 0x1p62)) fail();
    return static_cast<std::uint64_t>(value);
  }
  /// Returns the numbers that have not been read.
  std::span<const double> rest() const { return numbers_; }

 private:
  [[noreturn]] static void fail() {
    throw RunError(
        "the record of an iteration is damaged, or of another version of enfilade; solve again "
        "without --resume");
  }

  std::span<const double> numbers_;
};

}  // namespace enfilade
