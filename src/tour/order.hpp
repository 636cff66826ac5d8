// The order in which a rank's clusters gather: the paper's (§3.2), and its rivals (§7).
#pragma once

#include <memory>
#include <string>

#include "tour/tour.hpp"

namespace enfilade {

/// travelling_salesman  the paper's CYCLE, see below
/// greedy               always on to the cluster that costs least to go to
/// random               a permutation by the seed
/// input                by number, which runs through the building room by room
/// backtracking         through G_cluster depth first, see tour/backtracking.hpp
/// unshot_energy        the cluster with the most unshot energy before it, decided at each turn;
///                      see tour/unshot_energy.hpp
enum class TourOrder { travelling_salesman, greedy, random, input, backtracking, unshot_energy };
/// Returns the orders' names on the command line, in the enum's order: travelling-salesman, greedy,
/// ...
std::span<const char* const> order_names();
const char* name_of(TourOrder order);
/// Throws InputError for a name that is none of these.
TourOrder tour_order(const std::string& name);

/// One way to order a rank's clusters.
class Order {
 public:
  virtual ~Order() = default;
  /// Returns CYCLE: a permutation of the clusters.
  virtual std::vector<ClusterId> arrange(std::vector<ClusterId> clusters,
                                         const VisibilityCost& cost) const = 0;
  /// Returns the index of the cluster that gathers next, among those that have not gathered yet in
  /// this iteration (in CYCLE's order, at least one). The first, unless the order depends on the
  /// light.
  virtual std::size_t choose(std::span<const ClusterId>) const { return 0; }
  /// A gather of this rank has changed the receiver's power by this much: sum of area |B(k) -
  /// B(k-1)|.
  virtual void gathered(ClusterId, double) {}
};

/// travelling_salesman: asymmetric, nearest neighbour or the order given, whichever is cheaper,
/// then Or-opt and 3-opt segment moves. The number of moves tried is bounded by the number of
/// clusters, not by a clock, so that the tour repeats. `graph` must outlive the order.
/// emitted_power[c]: of cluster c; only unshot_energy needs it.
std::unique_ptr<Order> make_order(TourOrder order, std::uint64_t seed, const ClusterGraph& graph,
                                  std::vector<double> emitted_power = {});

}  // namespace enfilade
