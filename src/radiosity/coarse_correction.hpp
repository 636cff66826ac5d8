// A coarse correction over clusters: one unknown a cluster and band, so that the slow, smooth part
// of the error does not wait for light to be gathered from room to room and back, whatever the
// number of ranks.
//
// Iterative aggregation (Takahashi 1975; Schweitzer 1991): the light of each group's polygons keeps
// its proportions and is scaled by one factor z, such that every group's balance holds (over a
// polygon what is added is spread as evenly as its dark parts allow: light of many reflections is
// smooth): with P the power
// that arrives at a group and f_cd what of it comes from group d by reflection,
//   P_c z_c = (P_c - sum_d f_cd) + sum_d f'_cd z_d,   f' = f, times P_new / P_old of the shooting
// group where its light was read as it was before this iteration's gather. A group in the dark
// stays dark, and light that belongs to nobody (left over from a coarser mesh) dies at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/ids.hpp"
#include "clusters/cluster.hpp"

namespace enfilade {

/// One receiving cluster's row of the coarse system, filled by gather(). Powers: area times
/// irradiance, the scene's unit times m2.
struct CoarseRow {
  struct Entry {
    ClusterId shooter;
    bool stale = false;        ///< the shooter had not been gathered for in this iteration yet
    std::vector<double> flow;  ///< per band: power that came from what the shooter reflects
  };
  std::vector<double> before, after;  ///< per band: power that arrives, last gather and this one
  /// Per band, what of the power after is absorbed, and what of it leaves for good once reflected.
  std::vector<double> absorbed, escaping;
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
  /// Relative change of the light, z - 1: [group * bands + band]. Zero where nothing is coupled.
  std::vector<double> solve() const;
  /// Sum over groups of |change| in power, worst band: what is still missing.
  double power(std::span<const double> changes) const;
  /// Per band: what the changes add to the power that is absorbed, and to that which escapes.
  std::vector<double> absorbed(std::span<const double> changes) const {
    return sum(absorbed_, changes);
  }
  std::vector<double> escaping(std::span<const double> changes) const {
    return sum(escaping_, changes);
  }

  /// As numbers, for a message.
  std::vector<double> to_numbers() const;
  static CoarseSystem from_numbers(std::span<const double> numbers);

 private:
  struct Coupling {
    std::uint32_t column;
    std::vector<double> fresh, stale;  // per band: power that flows from the column's group
  };
  Coupling& coupling(std::size_t row, std::uint32_t column);
  std::vector<double> solve_band(std::size_t band) const;
  std::vector<double> sum(std::span<const double> power, std::span<const double> changes) const;

  std::size_t groups_, bands_;
  // Power, [group * bands + band].
  std::vector<double> before_, after_, absorbed_, escaping_;
  std::vector<std::vector<Coupling>> rows_;  // by ascending column
};

}  // namespace enfilade
