// Closure of the rows of form factors: each leaf's row is made to sum to its enclosed share.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "far_field/building_light.hpp"
#include "gather/row_sums.hpp"
#include "occluders/openness.hpp"

namespace enfilade {

/// Least numbers of rays that measure how open the leaves are.
struct OpennessRays {
  int rings = 4;               ///< of a leaf: as of enclosed_share()
  double per_cluster = 512.0;  ///< of its leaves together: a narrow opening must not be missed
};

/// The effect of a closure, summed over the leaves.
struct RowClosureSums {
  Spectrum uncertain_power;  ///< per band: area times uncertain irradiance
  RowSums rows;              ///< before the closure
};

/// Sums the rows of one receiving cluster while its light is gathered. Then adds to each leaf (or
/// takes from it) light for the difference between its row's sum and the target: the leaf's
/// enclosed share, which is 1 where every ray from the leaf ends on a lit front side.
class RowClosure {
 public:
  /// `far`: the light of clusters that are not added as shooters; null where all are. Both must
  /// outlive it.
  RowClosure(ClusterState& receiver, const BuildingLight* far, const OpennessRays& rays);

  /// Records which polygons of a shooter are lit. Shooters come in ascending order of id.
  void add_shooter(const ClusterState& shooter);
  /// Adds a link to its receiver's row. `light`: the shooter's mean radiosity per band, which
  /// varies by `variation` (RMS, worst band). `reflected`: the reflected part of it, of a far
  /// shooter alone.
  void add(const Link& link, std::span<const float> transport, std::span<const double> light,
           std::span<const double> reflected, double variation);
  /// Adds to `gathered` (irradiance, indexed like the light of the patches) `flux_correction` (per
  /// band, may be empty) times each leaf's uncertain irradiance, then the light for its row's
  /// deficit.
  RowClosureSums close(const Occluders& occluders, const Spectrum& flux_correction, WorkCount& work,
                       std::vector<double>& gathered);

 private:
  /// A row is affine over its node; its first number is the mean. Where each sum stands:
  struct Columns {
    std::size_t factor;       ///< of the factors, as constants over their receivers
    std::size_t uncertainty;  ///< of the links' uncertainties (estimated errors per m2)
    std::size_t doubtful;     ///< of the factors, each no more than its uncertainty
    std::size_t far_factor;   ///< of the factors of links from far shooters
    std::size_t far_gain;     ///< of the same links' transports of reflected light
    // Per band:
    std::size_t uncertain_light;  ///< of uncertainty times light
    std::size_t doubtful_light;   ///< of the doubtful factor times light
    std::size_t light;            ///< of factor times light
    std::size_t far_light;        ///< of the transports of far_gain times reflected light
    std::size_t
        uncertain_arrival;  ///< of (uncertainty + effect of the shooter's variation) * light
    std::size_t width;
    Columns(std::size_t terms, std::size_t bands);
  };
  /// What a link adds to a row.
  struct Addition {
    double factor, uncertainty, uncertainty_of_variation;
    double far_gain = 0.0;  ///< transport of reflected light, of a far shooter
  };
  /// The deficit of a leaf's row; below zero where the row sums to more than its target.
  struct Deficit {
    double gain = 1.0;     ///< weight of the target against the links' own sum
    double missing = 0.0;  ///< gain * (target - row sum)
    double beyond = 0.0;   ///< the part of `missing` that exceeds the links' uncertainty
    double within() const { return missing - beyond; }
  };
  void add(std::size_t node, const Addition& addition, std::span<const double> light,
           std::span<const double> reflected);
  double* row(std::size_t node) { return rows_.data() + node * at_.width; }
  const double* row(std::size_t node) const { return rows_.data() + node * at_.width; }
  double uncertainty(std::size_t node) const { return row(node)[at_.uncertainty]; }
  double uncertain_light(std::size_t node, std::size_t band) const {
    return row(node)[at_.uncertain_arrival + band];
  }
  /// Measures the enclosed shares that are not known yet. Returns per polygon: 1 where a leaf of it
  /// sees an opening.
  std::vector<char> find_openings(int rings, const Occluders& occluders, WorkCount& work);
  void correct_flux(std::size_t leaf, const Spectrum& flux_correction,
                    std::vector<double>& gathered) const;
  Deficit deficit(std::size_t leaf, bool open, double rays) const;
  double own_radiosity(std::size_t leaf, std::size_t band, double beyond, double arrived) const;
  void add_missing(std::size_t leaf, const Deficit& deficit, std::span<const double> arrived,
                   std::vector<double>& gathered);
  void take_excess(std::size_t leaf, const Deficit& deficit, std::vector<double>& gathered) const;
  void limit_gain(std::size_t leaf, double added, std::vector<double>& gathered) const;

  /// Of the light beyond the links' uncertainty at the leaf at hand.
  struct Beyond {
    bool dark = false;  ///< nothing arrives at the leaf
    bool own = false;   ///< it is the leaf's own radiosity
  };
  bool lit(const PolygonRef& polygon) const;

  ClusterState& receiver_;
  const BuildingLight* far_;
  OpennessRays least_;
  std::size_t bands_, lead_bands_, terms_;
  Columns at_;
  std::vector<double> rows_;         ///< per node
  std::vector<Beyond> lead_beyond_;  ///< per lead band
  std::vector<char> lit_;            ///< the shooters' polygons, one shooter after the other
  std::vector<std::pair<ClusterId, std::size_t>> lit_from_;  ///< by shooter: its first in lit_
  std::uint32_t lit_in_view_ = 0;                            ///< number of lit polygons
};

}  // namespace enfilade
