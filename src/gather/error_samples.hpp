// A second opinion on the light of a cluster: gathered anew at sampled points, by closed forms and
// rays that the links had no part in. What it differs by is the residual, the one part of the
// error that can be seen without knowing the answer (Lischinski, Smits, Greenberg 1994).
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "base/work_count.hpp"
#include "final_gather/visible_nodes.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

struct ErrorSampleConfig {
  int rays = 0;  ///< a point, in two independent halves; 0 = no points
  /// Points lie densest where much light arrives: points a m2, and a unit of power (area times
  /// irradiance, worst band).
  double per_area = 0.0, per_power = 0.0;
  double mean_irradiance = 0.0;  ///< of the whole scene; what darkness is relative to
};

/// Sums over points of the area that each stands for, times irradiance; per band.
struct ErrorSampleSums {
  Spectrum light;    ///< what the points receive
  Spectrum surplus;  ///< that less what the patches have there, with its sign
  Spectrum off;      ///< the same without
  Spectrum noise;    ///< share of `off` that is the sampling's own: what its two halves differ by
};
/// Adds a part (a cluster's, a rank's).
void add(ErrorSampleSums& sums, const ErrorSampleSums& part);

/// Points on one receiving cluster, fed with one shooting cluster after the other.
class ErrorSamples {
 public:
  ErrorSamples(const ClusterState& receiver, const Occluders& occluders,
               const ErrorSampleConfig& config, WorkCount& work);

  /// Adds what the points get from a light.
  void from(const PointLight& light);
  /// Adds what they get from a cluster, at most once each.
  void from(const ClusterState& shooter);
  /// Holds what has come in against the irradiance of the receiver's patches.
  ErrorSampleSums compare(const ClusterState& receiver) const;

 private:
  struct Point {
    std::uint32_t polygon;
    Vec3 x, n;
    double area_m2;     ///< that it stands for
    double irradiance;  ///< on the patches, before; worst band
    std::array<Spectrum, 2> light;
    std::vector<VisibleNode> counted;      ///< of the shooter at hand: what they bring is in light
    double counted_factor = 0.0;           ///< of all shooters: form factors
    std::array<double, 2> counted_rays{};  ///< and the share of the rays that met what was counted
    /// What rays brought, sum of both halves: those that met nothing counted, and all that met
    /// nothing bright.
    Spectrum left_to_rays{}, met_by_rays{};
  };
  struct Hit {
    PolygonRef polygon;
    std::uint32_t point;
    int half;
    Vec3 y;
  };
  void place(const ClusterState& receiver);
  void cast_rays();
  double light_at(const Point& point) const {
    return std::max(point.irradiance, 1e-3 * config_.mean_irradiance);
  }
  double share_of(const PatchForest& forest, std::uint32_t polygon, const Point& point) const;
  bool is_bright(const PatchForest& forest, std::size_t polygon, const Point& point) const;
  void count_nodes(const ClusterState& shooter, Point& point);
  void from_bright(const ClusterState& shooter, std::uint32_t polygon, Point& point);
  double light_of(const Point& point, std::size_t half, std::size_t band) const;

  const Occluders* occluders_;
  ErrorSampleConfig config_;
  WorkCount* work_;
  ClusterId receiver_;
  std::size_t bands_;
  Random random_;
  std::vector<Point> points_;
  std::vector<Hit> hits_;  ///< by cluster
  VisibleNodes seen_;
};

}  // namespace enfilade
