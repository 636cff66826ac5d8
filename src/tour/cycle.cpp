#include <algorithm>
#include <numeric>

#include "base/error.hpp"
#include "base/random.hpp"
#include "tour/segment_moves.hpp"
#include "tour/tour.hpp"

namespace enfilade {

namespace {

constexpr std::size_t candidates_a_cluster = 8;

std::uint64_t cost_of_round(const std::vector<ClusterId>& order, const VisibilityCost& cost) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sum += cost.between(order[i], order[(i + 1) % order.size()]);
  }
  return sum;
}

std::vector<ClusterId> at_places(const std::vector<ClusterId>& clusters,
                                 const std::vector<std::uint32_t>& places) {
  std::vector<ClusterId> order;
  for (std::uint32_t i : places) order.push_back(clusters[i]);
  return order;
}

/// Nearest neighbour, and where asked the better tour that segment moves make of it or of the order
/// given.
std::vector<ClusterId> cheap_order(const std::vector<ClusterId>& clusters,
                                   const VisibilityCost& cost, bool improve, std::uint64_t seed) {
  const CandidateLists candidates = candidate_lists(clusters, cost, candidates_a_cluster);
  const std::uint32_t start = static_cast<std::uint32_t>(Random(seed).below(clusters.size()));
  std::vector<std::uint32_t> places = nearest_neighbour_tour(clusters, cost, candidates, start);
  if (!improve) return at_places(clusters, places);
  // Ids run through the building room by room, which can be the better start.
  std::vector<std::uint32_t> given(clusters.size());
  std::iota(given.begin(), given.end(), 0u);
  if (cost_of_round(clusters, cost) < cost_of_round(at_places(clusters, places), cost)) {
    places = given;
  }
  SegmentMoveConfig config;
  config.seed = seed;
  return at_places(clusters, improve_tour(std::move(places), clusters, cost, candidates, config));
}

std::vector<ClusterId> shuffled(std::vector<ClusterId> clusters, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = clusters.size(); i > 1; --i)
    std::swap(clusters[i - 1], clusters[random.below(i)]);
  return clusters;
}

}  // namespace

TourOrder tour_order(const std::string& name) {
  if (name == "travelling-salesman") return TourOrder::travelling_salesman;
  if (name == "greedy") return TourOrder::greedy;
  if (name == "random") return TourOrder::random;
  if (name == "input") return TourOrder::input;
  throw InputError("--order", "'" + name + "'", "no order has this name",
                   "use travelling-salesman, greedy, random or input");
}

Cycle::Cycle(std::vector<ClusterId> clusters, const VisibilityCost& cost, TourOrder order,
             std::uint64_t seed)
    : order_(std::move(clusters)) {
  switch (order) {
    case TourOrder::input:
      break;
    case TourOrder::random:
      order_ = shuffled(std::move(order_), seed);
      break;
    case TourOrder::greedy:
    case TourOrder::travelling_salesman:
      if (order_.size() > 2) {
        order_ = cheap_order(order_, cost, order == TourOrder::travelling_salesman, seed);
      }
      break;
  }
  cost_bytes_ = cost_of_round(order_, cost);
}

void Cycle::remove(ClusterId cluster, const VisibilityCost& cost) {
  const auto at = std::find(order_.begin(), order_.end(), cluster);
  if (at == order_.end()) return;
  const std::size_t n = order_.size(), i = static_cast<std::size_t>(at - order_.begin());
  const ClusterId before = order_[(i + n - 1) % n], after = order_[(i + 1) % n];
  order_.erase(at);
  if (n == 1) {
    cost_bytes_ = 0;
    return;
  }
  cost_bytes_ -= cost.between(before, cluster) + cost.between(cluster, after);
  cost_bytes_ += cost.between(before, after);
}

}  // namespace enfilade
