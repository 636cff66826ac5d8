// OVG's edges by sets of 64 clusters a word.
#include <algorithm>
#include <bit>

#include "base/error.hpp"
#include "tour/tour.hpp"

namespace enfilade {

VisibilityCost::VisibilityCost(const ClusterGraph& graph, std::vector<std::uint64_t> bytes,
                               std::uint64_t memory_bytes,
                               std::vector<std::uint64_t> receiver_bytes)
    : graph_(&graph),
      bytes_(std::move(bytes)),
      receiver_bytes_(std::move(receiver_bytes)),
      memory_bytes_(memory_bytes) {
  ENFILADE_CHECK(bytes_.size() == graph.size(), std::to_string(bytes_.size()));
  ENFILADE_CHECK(receiver_bytes_.empty() || receiver_bytes_.size() == graph.size(),
                 std::to_string(receiver_bytes_.size()));
  first_word_.push_back(0);
  needed_.resize(graph.size());
  for (std::uint32_t c = 0; c < graph.size(); ++c) {
    const auto add = [this](std::uint32_t id) {
      if (words_.size() == first_word_.back() || words_.back().index != id / 64) {
        words_.push_back({id / 64, 0, 0});
      }
      words_.back().bits |= std::uint64_t{1} << (id % 64);
      words_.back().bytes += bytes_[id];
    };
    const auto row = graph.neighbours(c);
    const auto above = std::lower_bound(row.begin(), row.end(), c);
    std::for_each(row.begin(), above, add);
    add(c);
    std::for_each(above, row.end(), add);
    first_word_.push_back(words_.size());
    needed_[c] = receiver_bytes_.empty() ? 0 : receiver_bytes_[c];
    for (const Word& word : words(c)) needed_[c] += word.bytes;
  }
}

std::uint64_t VisibilityCost::bytes_of(std::uint32_t index, std::uint64_t bits) const {
  std::uint64_t sum = 0;
  for (; bits != 0; bits &= bits - 1) {
    sum += bytes_[std::size_t{64} * index + static_cast<std::size_t>(std::countr_zero(bits))];
  }
  return sum;
}

std::uint64_t VisibilityCost::bytes_without(const Word& word, std::uint64_t held) const {
  const std::uint64_t missing = word.bits & ~held;
  return missing == word.bits ? word.bytes : bytes_of(word.index, missing);
}

std::uint64_t VisibilityCost::between(ClusterId from, ClusterId to) const {
  const auto held = words(from.index());
  auto h = held.begin();
  std::uint64_t missing = receiver_bytes(to.index());
  for (const Word& word : words(to.index())) {
    while (h != held.end() && h->index < word.index) ++h;
    const std::uint64_t known = h != held.end() && h->index == word.index ? h->bits : 0;
    missing += bytes_without(word, known);
  }
  // No more than the memory holds can have stayed.
  const std::uint64_t kept = std::min(needed_[to.index()] - missing, memory_bytes_);
  return needed_[to.index()] - kept;
}

std::vector<std::uint64_t> VisibilityCost::given(std::span<const ClusterId> resident,
                                                 std::span<const ClusterId> receivers) const {
  std::vector<std::uint64_t> held(bytes_.size() / 64 + 1, 0);
  for (const ClusterId r : resident) held[r.index() / 64] |= std::uint64_t{1} << (r.index() % 64);
  std::vector<std::uint64_t> missing;
  for (const ClusterId receiver : receivers) {
    std::uint64_t bytes = receiver_bytes(receiver.index());
    for (const Word& word : words(receiver.index())) {
      bytes += bytes_without(word, held[word.index]);
    }
    missing.push_back(bytes);
  }
  return missing;
}

}  // namespace enfilade
