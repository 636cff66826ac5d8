// A coarse correction over clusters: one unknown a cluster and band, or a few where there are few
// clusters (aggregates.hpp), so that the slow, smooth part of the error does not wait for light
// to be gathered from room to room and back, or along a corridor, whatever the number of ranks.
//
// Iterative aggregation (Takahashi 1975; Schweitzer 1991): the light of what shares an unknown
// keeps its proportions and is scaled by one factor z, such that every balance holds (over a
// polygon what is added is spread as evenly as its dark parts allow: light of many reflections is
// smooth): with P the power that arrives at unknown c and f_cd what of it comes from d by
// reflection,
//   P_c z_c = (P_c - sum_d f_cd) + sum_d f'_cd z_d,   f' = f, times P_new / P_old of the shooter
// where its light was read as it was before this iteration's gather. How light is shared out
// between aggregates need only be roughly right: once it is at rest, z = 1 solves this whatever f
// is. What is in the dark stays dark, and light that belongs to nobody (left over from a coarser
// mesh) dies at once.
#pragma once

#include <cstdint>
#include <functional>
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
    bool stale = false;  ///< the shooter had not been gathered for in this iteration yet
    std::vector<double>
        flow;  ///< power that came from what the shooter reflects: AggregateFlow::take()
  };
  std::size_t aggregates = 1;  ///< of the receiving cluster
  // [aggregate * bands + band]
  std::vector<double> before, after;  ///< power that arrives, last gather and this one
  /// What of the power after is absorbed, and what of it leaves for good once reflected.
  std::vector<double> absorbed, escaping;
  std::vector<Entry> entries;  ///< by ascending shooter
};

/// Which unknowns the clusters have.
struct CoarseUnknowns {
  std::vector<std::uint32_t> first;       ///< by cluster
  std::vector<std::uint32_t> aggregates;  ///< by cluster: how many from there on, at most
  std::size_t count = 0;

  bool aggregated() const { return count > first.size(); }
  /// Counts them; false where these are not `clusters` clusters' unknowns in order, or `numbers`
  /// not as many for each.
  bool complete(std::size_t clusters, std::size_t numbers);
  /// A cluster's part of what there is for each unknown and band.
  std::span<const double> of(ClusterId cluster, std::span<const double> numbers,
                             std::size_t bands) const;
};
/// Up to `most` clusters have an unknown each, and if there are fewer than `least` unknowns then,
/// more for their aggregates, by area; more than `most` clusters share, those of a cell first.
CoarseUnknowns coarse_unknowns(std::span<const Cluster> clusters, std::size_t least = 128,
                               std::size_t most = 512);

/// Calls take(row, column, flow per band, stale) for the unknowns that light flows between.
void for_each_coupling(
    ClusterId receiver, const CoarseRow& row, const CoarseUnknowns& unknowns,
    const std::function<void(std::uint32_t, std::uint32_t, std::span<const double>, bool)>& take);

/// The coarse system; rows may be added on several ranks and the parts merged.
class CoarseSystem {
 public:
  CoarseSystem(std::size_t unknowns, std::size_t bands);

  void add(ClusterId receiver, const CoarseRow& row, const CoarseUnknowns& unknowns);
  /// Makes room for what flows from one unknown to another.
  void couple(std::uint32_t row, std::uint32_t column) { coupling(row, column); }
  void merge(const CoarseSystem& other);
  /// Relative change of the light, z - 1: [unknown * bands + band]. Zero where nothing is coupled.
  std::vector<double> solve(const CoarseUnknowns& unknowns) const;
  /// Sum over unknowns of |change| in power, worst band: what is still missing.
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
    std::vector<double> fresh, stale;  // per band: power that flows from the column
  };
  Coupling& coupling(std::size_t row, std::uint32_t column);
  std::vector<double> solve_band(const CoarseUnknowns& unknowns, std::size_t band) const;
  /// How light that an unknown gave has grown since it was read stale, and what the light that was
  /// read fresh and stale is multiplied by.
  struct Column {
    double growth = 1.0, fresh = 1.0, stale = 1.0;
  };
  std::vector<Column> columns(const CoarseUnknowns& unknowns, std::size_t band) const;
  std::vector<double> sum(std::span<const double> power, std::span<const double> changes) const;

  std::size_t unknowns_, bands_;
  // Power, [unknown * bands + band].
  std::vector<double> before_, after_, absorbed_, escaping_;
  std::vector<std::vector<Coupling>> rows_;  // by ascending column
};

}  // namespace enfilade
