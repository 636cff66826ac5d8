// The orders by name; the simple ones.
#include "tour/order.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/error.hpp"
#include "base/random.hpp"
#include "tour/backtracking.hpp"
#include "tour/segment_moves.hpp"
#include "tour/unshot_energy.hpp"

namespace enfilade {
namespace {

constexpr std::size_t candidates_a_cluster = 8;
constexpr std::array names = {"travelling-salesman", "greedy",       "random", "input",
                              "backtracking",        "unshot-energy"};

std::vector<ClusterId> at_places(const std::vector<ClusterId>& clusters,
                                 const std::vector<std::uint32_t>& places) {
  std::vector<ClusterId> order;
  for (const std::uint32_t i : places) order.push_back(clusters[i]);
  return order;
}

/// The nearest-neighbour tour; with `improve`, the cheaper of it and the given order, improved by
/// segment moves.
class CheapOrder final : public Order {
 public:
  CheapOrder(std::uint64_t seed, bool improve) : seed_(seed), improve_(improve) {}

  std::vector<ClusterId> arrange(std::vector<ClusterId> clusters,
                                 const VisibilityCost& cost) const override {
    if (clusters.size() <= 2) return clusters;
    const CandidateLists candidates = candidate_lists(clusters, cost, candidates_a_cluster);
    const auto start = static_cast<std::uint32_t>(Random(seed_).below(clusters.size()));
    std::vector<std::uint32_t> places = nearest_neighbour_tour(clusters, cost, candidates, start);
    if (!improve_) return at_places(clusters, places);
    // Ids run through the building room by room, which can be the better start.
    std::vector<std::uint32_t> given(clusters.size());
    std::iota(given.begin(), given.end(), 0u);
    if (cost_of_round(clusters, cost) < cost_of_round(at_places(clusters, places), cost)) {
      places = given;
    }
    SegmentMoveConfig config;
    config.seed = seed_;
    return at_places(clusters, improve_tour(std::move(places), clusters, cost, candidates, config));
  }

 private:
  std::uint64_t seed_;
  bool improve_;
};

class RandomOrder final : public Order {
 public:
  explicit RandomOrder(std::uint64_t seed) : seed_(seed) {}
  std::vector<ClusterId> arrange(std::vector<ClusterId> clusters,
                                 const VisibilityCost&) const override {
    Random random(seed_);
    for (std::size_t i = clusters.size(); i > 1; --i)
      std::swap(clusters[i - 1], clusters[random.below(i)]);
    return clusters;
  }

 private:
  std::uint64_t seed_;
};

class InputOrder final : public Order {
 public:
  std::vector<ClusterId> arrange(std::vector<ClusterId> clusters,
                                 const VisibilityCost&) const override {
    return clusters;
  }
};

}  // namespace

std::span<const char* const> order_names() { return names; }

const char* name_of(TourOrder order) { return names.at(static_cast<std::size_t>(order)); }

TourOrder tour_order(const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<TourOrder>(found - names.begin());
  throw InputError("--order", "'" + name + "'", "no order has this name",
                   "use one of those that 'enfilade solve --help' lists");
}

std::unique_ptr<Order> make_order(TourOrder order, std::uint64_t seed, const ClusterGraph& graph,
                                  std::vector<double> emitted_power) {
  switch (order) {
    case TourOrder::travelling_salesman:
      return std::make_unique<CheapOrder>(seed, /*improve=*/true);
    case TourOrder::greedy:
      return std::make_unique<CheapOrder>(seed, /*improve=*/false);
    case TourOrder::random:
      return std::make_unique<RandomOrder>(seed);
    case TourOrder::input:
      return std::make_unique<InputOrder>();
    case TourOrder::backtracking:
      return std::make_unique<Backtracking>();
    case TourOrder::unshot_energy:
      return std::make_unique<UnshotEnergy>(graph, std::move(emitted_power));
  }
  throw RunError("order " + std::to_string(static_cast<int>(order)));
}

}  // namespace enfilade
