// Local search over segment moves with a queue of changed places, and random kicks.
#include "tour/segment_moves.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <deque>
#include <utility>

#include "base/random.hpp"

namespace enfilade {

namespace {

/// The tour as an array; offsets count cyclically from a chosen place. Changes since remember() can
/// be taken back, in a time that follows the changes and not the tour.
class TourArray {
 public:
  explicit TourArray(std::vector<std::uint32_t> tour) : tour_(std::move(tour)), at_(tour_.size()) {
    for (std::uint32_t i = 0; i < tour_.size(); ++i) at_[tour_[i]] = i;
  }
  std::size_t size() const { return tour_.size(); }
  const std::vector<std::uint32_t>& places() const { return tour_; }
  std::uint32_t after(std::uint32_t a, std::size_t steps = 1) const {
    return tour_[(at_[a] + steps) % size()];
  }
  std::uint32_t before(std::uint32_t a) const { return tour_[(at_[a] + size() - 1) % size()]; }
  /// Steps from a to x.
  std::size_t offset(std::uint32_t a, std::uint32_t x) const {
    return (at_[x] + size() - at_[a]) % size();
  }

  /// a [1..p] [p+1..q] rest -> a [p+1..q] [1..p] rest. Of the three segments the longest stays
  /// where it is.
  void exchange(std::uint32_t a, std::size_t p, std::size_t q) {
    const std::size_t n = size(), first = at_[a] + 1;
    const std::array<std::size_t, 3> start{first, first + p, first + q}, length{p, q - p, n - q};
    const std::size_t longest =
        static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
    const std::size_t one = (longest + 1) % 3, two = (longest + 2) % 3;
    buffer_.clear();
    for (std::size_t i = 0; i < length[two]; ++i) buffer_.push_back(tour_[(start[two] + i) % n]);
    for (std::size_t i = 0; i < length[one]; ++i) buffer_.push_back(tour_[(start[one] + i) % n]);
    for (std::size_t i = 0; i < buffer_.size(); ++i) put((start[one] + i) % n, buffer_[i]);
  }
  /// Turns round the `count` places from `from` on.
  void reverse(std::uint32_t from, std::size_t count) {
    const std::size_t n = size(), first = at_[from];
    for (std::size_t i = 0; i < count / 2; ++i) {
      const std::size_t low = (first + i) % n, high = (first + count - 1 - i) % n;
      const std::uint32_t x = tour_[low];
      put(low, tour_[high]);
      put(high, x);
    }
  }

  void remember() {
    remembers_ = true;
    changes_.clear();
  }
  void take_back() {
    for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
      tour_[change->index] = change->before;
      at_[change->before] = change->index;
    }
    changes_.clear();
  }

 private:
  struct Change {
    std::uint32_t index, before;
  };
  void put(std::size_t index, std::uint32_t x) {
    const auto i = static_cast<std::uint32_t>(index);
    if (remembers_) changes_.push_back({i, tour_[i]});
    tour_[i] = x;
    at_[x] = i;
  }
  std::vector<std::uint32_t> tour_, at_, buffer_;
  bool remembers_ = false;
  std::vector<Change> changes_;
};

/// A cache of OVG's edges: the moves price the same edges again and again.
class PriceMemory {
 public:
  PriceMemory(const std::vector<ClusterId>& clusters, const VisibilityCost& cost)
      : clusters_(clusters), cost_(cost), known_(std::bit_ceil(64 * clusters.size())) {}
  std::uint64_t between(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t edge = (std::uint64_t{a} << 32) | b;
    Price& price = known_[(edge * 0x9E3779B97F4A7C15u >> 32) & (known_.size() - 1)];
    if (price.edge != edge) price = {edge, cost_.between(clusters_[a], clusters_[b])};
    return price.bytes;
  }

 private:
  struct Price {
    std::uint64_t edge = ~std::uint64_t{0}, bytes = 0;
  };
  const std::vector<ClusterId>& clusters_;
  const VisibilityCost& cost_;
  std::vector<Price> known_;
};

class Improver {
 public:
  Improver(std::vector<std::uint32_t> tour, const std::vector<ClusterId>& clusters,
           const VisibilityCost& cost, const CandidateLists& candidates,
           const SegmentMoveConfig& config)
      : tour_(std::move(tour)),
        prices_(clusters, cost),
        near_(candidates),
        config_(config),
        budget_(config.costs_a_cluster * tour_.size()),
        edge_(tour_.size()),
        queued_(tour_.size(), false) {
    for (std::uint32_t a : tour_.places()) {
      edge_[a] = price(a, tour_.after(a));
      total_ += edge_[a];
      push(a);
    }
  }

  std::vector<std::uint32_t> run() {
    settle();
    Random random(config_.seed);
    const std::uint64_t kicks = static_cast<std::uint64_t>(config_.kicks_a_cluster) * tour_.size();
    for (std::uint64_t k = 0; k < kicks && tried_ < budget_; ++k) kick(random);
    return tour_.places();
  }

 private:
  std::uint64_t price(std::uint32_t a, std::uint32_t b) {
    ++tried_;
    return prices_.between(a, b);
  }
  void push(std::uint32_t a) {
    if (queued_[a]) return;
    queued_[a] = true;
    queue_.push_back(a);
  }

  /// Moves segments until no move of a segment behind a queued place gains, or the budget is spent.
  void settle() {
    while (!queue_.empty()) {
      const std::uint32_t a = queue_.front();
      queue_.pop_front();
      queued_[a] = false;
      while (tried_ < budget_ && (or_opt(a) || exchange_after(a))) continue;
    }
  }

  /// Moves the next 1, 2 or 3 clusters after a next to one of their candidates.
  bool or_opt(std::uint32_t a) {
    const std::size_t longest = std::min(config_.longest_or_opt, tour_.size() - 2);
    for (std::size_t count = 1; count <= longest; ++count) {
      const std::uint32_t b = tour_.after(a), c = tour_.after(a, count), d = tour_.after(c);
      const std::uint64_t removed = edge_[a] + edge_[c], joined = price(a, d);
      if (removed <= joined) continue;
      for (bool turned : {false, true}) {
        if (turned && count == 1) continue;
        const std::uint32_t head = turned ? c : b, tail = turned ? b : c;
        const std::uint64_t turn = turned ? turning_cost(b, count) : 0;
        for (std::uint32_t e : near_.before[head]) {
          if (try_insert(a, count, e, turned, removed, joined + turn)) return true;
        }
        for (std::uint32_t f : near_.after[tail]) {
          if (try_insert(a, count, tour_.before(f), turned, removed, joined + turn)) return true;
        }
      }
    }
    return false;
  }

  /// Cost of travelling the segment backwards. Compared with `forward_cost`, which is no longer
  /// paid.
  std::uint64_t turning_cost(std::uint32_t b, std::size_t count) {
    std::uint64_t backwards = 0;
    for (std::uint32_t x = b; --count > 0; x = tour_.after(x))
      backwards += price(tour_.after(x), x);
    return backwards;
  }
  std::uint64_t forward_cost(std::uint32_t b, std::size_t count) const {
    std::uint64_t forwards = 0;
    for (std::uint32_t x = b; --count > 0; x = tour_.after(x)) forwards += edge_[x];
    return forwards;
  }

  bool try_insert(std::uint32_t a, std::size_t count, std::uint32_t e, bool turned,
                  std::uint64_t removed, std::uint64_t joined) {
    const std::size_t q = tour_.offset(a, e);
    if (q <= count) return false;  // e is a itself or in the segment
    const std::uint32_t b = tour_.after(a), c = tour_.after(a, count), f = tour_.after(e);
    const std::uint64_t before =
        removed + edge_[e] + (turned ? forward_cost(b, count) : std::uint64_t{0});
    const std::uint64_t after = joined + price(e, turned ? c : b) + price(turned ? b : c, f);
    if (after >= before) return false;
    tour_.exchange(a, count, q);
    if (turned) tour_.reverse(b, count);
    refresh(a);
    refresh(e);
    for (std::size_t i = 0; i < count; ++i) refresh(tour_.after(e, i + 1));
    return true;
  }

  /// a->b..c->d..e->f becomes a->d..e->b..c->f. Of the three gains "old edge minus new edge from
  /// the same place" one must be positive where the sum is, and each of the three places gets its
  /// turn as a.
  bool exchange_after(std::uint32_t a) {
    const std::uint32_t b = tour_.after(a);
    for (std::uint32_t d : near_.after[a]) {
      const std::uint64_t first = price(a, d);
      if (first >= edge_[a]) return false;
      if (d == b) continue;
      const std::uint32_t c = tour_.before(d);
      for (std::uint32_t f : near_.after[c]) {
        if (try_exchange(a, d, tour_.before(f), first)) return true;
      }
      for (std::uint32_t e : near_.before[b]) {
        if (try_exchange(a, d, e, first)) return true;
      }
    }
    return false;
  }

  bool try_exchange(std::uint32_t a, std::uint32_t d, std::uint32_t e, std::uint64_t first) {
    const std::size_t p = tour_.offset(a, d) - 1, q = tour_.offset(a, e);
    if (q <= p) return false;
    const std::uint32_t b = tour_.after(a), c = tour_.before(d), f = tour_.after(e);
    if (first + price(e, b) + price(c, f) >= edge_[a] + edge_[c] + edge_[e]) return false;
    tour_.exchange(a, p, q);
    for (std::uint32_t x : {a, c, e}) refresh(x);
    return true;
  }

  /// The way on from x has changed.
  void refresh(std::uint32_t x) {
    total_ -= edge_[x];
    if (remembers_) old_edges_.emplace_back(x, edge_[x]);
    edge_[x] = price(x, tour_.after(x));
    total_ += edge_[x];
    push(x);
    push(tour_.after(x));
    push(tour_.before(x));
  }

  /// Swaps two random short neighbouring segments, settles, and goes back where nothing was gained.
  void kick(Random& random) {
    const std::size_t n = tour_.size();
    if (n < 8) return;
    tour_.remember();
    remembers_ = true;
    old_edges_.clear();
    const std::uint64_t old_total = total_;
    const std::uint32_t a = static_cast<std::uint32_t>(random.below(n));
    const std::uint64_t longest = std::min<std::uint64_t>(50, (n - 2) / 2);
    const std::size_t p = 1 + random.below(longest), q = p + 1 + random.below(longest);
    const std::uint32_t c = tour_.after(a, p), e = tour_.after(a, q);
    tour_.exchange(a, p, q);
    for (std::uint32_t x : {a, c, e}) refresh(x);
    settle();
    if (total_ <= old_total) return;
    tour_.take_back();
    for (auto edge = old_edges_.rbegin(); edge != old_edges_.rend(); ++edge)
      edge_[edge->first] = edge->second;
    total_ = old_total;
  }

  TourArray tour_;
  PriceMemory prices_;
  const CandidateLists& near_;
  SegmentMoveConfig config_;
  std::uint64_t budget_, tried_ = 0, total_ = 0;
  std::vector<std::uint64_t> edge_;  ///< cost of going on from each place
  bool remembers_ = false;
  std::vector<std::pair<std::uint32_t, std::uint64_t>> old_edges_;  ///< since the last kick began
  std::deque<std::uint32_t> queue_;
  std::vector<bool> queued_;
};

}  // namespace

std::vector<std::uint32_t> improve_tour(std::vector<std::uint32_t> tour,
                                        const std::vector<ClusterId>& clusters,
                                        const VisibilityCost& cost,
                                        const CandidateLists& candidates,
                                        const SegmentMoveConfig& config) {
  if (tour.size() < 3) return tour;
  return Improver(std::move(tour), clusters, cost, candidates, config).run();
}

}  // namespace enfilade
