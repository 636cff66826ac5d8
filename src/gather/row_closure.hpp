// Closing the rows of form factors: energy neither made nor lost by the links' errors.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "occluders/openness.hpp"

namespace enfilade {

/// Sums the rows of one receiving cluster while its light is gathered, then gives each leaf what
/// its row lacks (or has too much) of the share that it must sum to: 1 where every ray from the
/// patch ends on a lit front side, else what exposure rays say, weighed against the links' doubt.
/// What it lacks beyond that doubt is as dark as the leaf itself, if that is darker.
class RowClosure {
 public:
  explicit RowClosure(ClusterState& receiver);

  /// Notes which of a shooter's polygons give light. Shooters come by rising id.
  void see(const ClusterState& shooter);
  /// A link's share of its receiver's row. `light`: the shooter's mean radiosity per band, which
  /// varies by `variation` (RMS, worst band).
  void add(const Link& link, std::span<const float> transport, std::span<const double> light,
           double variation);
  /// Adds to `gathered` (indexed like the light of the patches) the missing light, then
  /// `flux_correction` (per band, may be empty) times each leaf's doubtful light.
  void close(const Occluders& occluders, const Spectrum& flux_correction, WorkCount& work,
             std::vector<double>& gathered);
  /// After that: area times doubtful light over the leaves, per band.
  const Spectrum& uncertain_power() const { return uncertain_power_; }

 private:
  void add(std::size_t node, double factor, double uncertainty, std::span<const double> light,
           double uncertainty_of_variation);
  double* row(std::size_t node) { return rows_.data() + node * width_; }
  /// Measures what was not measured yet; true per polygon: one of its leaves sees an opening.
  std::vector<char> find_openings(int rings, const Occluders& occluders, WorkCount& work);
  double own_light(std::size_t leaf, std::size_t band, double unseen, double arrived) const;

  ClusterState& receiver_;
  std::size_t bands_, terms_, width_;
  /// Per node: the row's sum as an affine function, the links' uncertainty, per band their light
  /// weighted by it, and per band the doubtful light: that and what varies over the shooters.
  std::vector<double> rows_;
  Spectrum uncertain_power_;
  std::vector<char> lit_;  ///< the shooters' polygons, one shooter after the other
  std::vector<std::pair<ClusterId, std::size_t>> lit_from_;  ///< where a shooter's begin, rising
  std::uint32_t lit_in_view_ = 0;                            ///< polygons
};

}  // namespace enfilade
