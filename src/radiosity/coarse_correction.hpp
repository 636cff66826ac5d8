// A coarse correction over clusters: one unknown a cluster and band, so that the slow, smooth part
// of the error does not wait for light to be gathered from room to room and back, whatever the
// number of ranks.
//
// With E the irradiance and K the gathering operator (E = K (M + rho E) + direct), one sweep of the
// paper's group iteration leaves the residual r = K_stale rho (E_new - E_old), where K_stale holds
// the links that read a value from before the sweep. Galerkin over clusters, offsets d constant on
// each:
//   (S - K) d = K_stale D / S,   S = area, K_cd = sum of A_i F_ij rho_j, D = sum of A (E_new -
//   E_old).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "clusters/cluster.hpp"

namespace enfilade {

/// One receiving cluster's row of the coarse system, filled by gather().
struct CoarseRow {
  struct Entry {
    ClusterId shooter;
    bool stale = false;            ///< the shooter had not been gathered for in this iteration yet
    std::vector<double> coupling;  ///< per band: sum of A_i F_ij rho_j, m2
  };
  double area_m2 = 0.0;
  std::vector<double> change;  ///< per band: sum of A (E_new - E_old)
  std::vector<Entry> entries;  ///< by ascending shooter
};

/// group[cluster] = its unknown. Clusters are unknowns themselves up to `most`; beyond, those of a
/// cell share.
std::vector<std::uint32_t> coarse_groups(std::span<const Cluster> clusters, std::size_t most = 512);

/// The coarse system; rows may be added on several ranks and the parts merged.
class CoarseSystem {
 public:
  CoarseSystem(std::size_t groups, std::size_t bands);

  void add(std::uint32_t group, const CoarseRow& row,
           std::span<const std::uint32_t> group_of_cluster);
  void merge(const CoarseSystem& other);
  /// Offsets of the irradiance: [group * bands + band]. Zero where nothing is coupled.
  std::vector<double> solve() const;
  /// Sum over groups of area times |offset|, worst band: what is still missing, in power.
  double power(std::span<const double> offsets) const;

  /// As numbers, for a message.
  std::vector<double> to_numbers() const;
  static CoarseSystem from_numbers(std::span<const double> numbers);

 private:
  struct Coupling {
    std::uint32_t column;
    std::vector<double> all, stale;  // per band
  };
  std::size_t groups_, bands_;
  std::vector<double> area_, change_;
  std::vector<std::vector<Coupling>> rows_;  // by ascending column
};

}  // namespace enfilade
