// A set of ranks, as bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/ids.hpp"

namespace enfilade {

class RankSet {
 public:
  RankSet() = default;
  explicit RankSet(std::vector<std::uint64_t> words) : words_(std::move(words)) {}

  void add(Rank rank) {
    const auto r = static_cast<std::size_t>(rank.value);
    if (words_.size() <= r / 64) words_.resize(r / 64 + 1, 0);
    words_[r / 64] |= std::uint64_t{1} << (r % 64);
  }
  void add(const RankSet& others) {
    if (words_.size() < others.words_.size()) words_.resize(others.words_.size(), 0);
    for (std::size_t w = 0; w < others.words_.size(); ++w) words_[w] |= others.words_[w];
  }
  bool has(Rank rank) const {
    const auto r = static_cast<std::size_t>(rank.value);
    return r / 64 < words_.size() && (words_[r / 64] >> (r % 64) & 1) != 0;
  }
  const std::vector<std::uint64_t>& words() const { return words_; }

 private:
  std::vector<std::uint64_t> words_;
};

}  // namespace enfilade
