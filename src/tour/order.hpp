// In which order a rank's clusters gather: the paper's (§3.2), and those that it must beat (§7).
#pragma once

#include <memory>
#include <string>

#include "tour/tour.hpp"

namespace enfilade {

/// travelling_salesman  the paper's CYCLE, see below
/// greedy               always on to the cluster that costs least to go to
/// random               as the seed has it
/// input                by number, which runs through the building room by room
/// backtracking         through G_cluster depth first, see tour/backtracking.hpp
/// unshot_energy        where most light waits, decided from turn to turn, see
///                      tour/unshot_energy.hpp
enum class TourOrder { travelling_salesman, greedy, random, input, backtracking, unshot_energy };
/// What users call them, in the enum's order: travelling-salesman, greedy, ...
std::span<const char* const> order_names();
const char* name_of(TourOrder order);
/// Throws InputError for a name that is none of these.
TourOrder tour_order(const std::string& name);

/// One way to order them.
class Order {
 public:
  virtual ~Order() = default;
  /// CYCLE: each of the clusters once.
  virtual std::vector<ClusterId> arrange(std::vector<ClusterId> clusters,
                                         const VisibilityCost& cost) const = 0;
  /// Which of those that wait has its turn now; they come as CYCLE has them, and at least one. The
  /// first, unless the order looks at the light.
  virtual std::size_t choose(std::span<const ClusterId>) const { return 0; }
  /// A gather of this rank has changed the receiver's light by so much power (sum of area |B(k) -
  /// B(k-1)|).
  virtual void gathered(ClusterId, double) {}
};

/// travelling_salesman: asymmetric, nearest neighbour or the order given, whichever is cheaper,
/// then Or-opt and 3-opt segment moves. The number of moves tried is bounded by the number of
/// clusters, not by a clock, so that the tour repeats. `graph` must outlive the order.
/// emitted_power[c]: of cluster c; only unshot_energy needs it.
std::unique_ptr<Order> make_order(TourOrder order, std::uint64_t seed, const ClusterGraph& graph,
                                  std::vector<double> emitted_power = {});

}  // namespace enfilade
