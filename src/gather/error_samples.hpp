// A-posteriori error samples: the irradiance at sampled points of a cluster, gathered anew by
// closed forms and rays, independently of the links. Its difference from the patches' irradiance is
// the part of the error that can be measured without the exact solution (Lischinski, Smits,
// Greenberg 1994).
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "base/work_count.hpp"
#include "far_field/far_view.hpp"
#include "final_gather/visible_nodes.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

struct ErrorSampleConfig {
  int rays = 0;  ///< for each point, in two independent halves; 0 = no points
  /// Points per m2, plus points per unit of power (area times irradiance, largest band): they lie
  /// densest where much light arrives.
  double per_area = 0.0, per_power = 0.0;
  double mean_irradiance = 0.0;  ///< of the whole scene; floors the reference irradiance
  /// RefinementConfig::importance: points lie denser by it, and count by it.
  std::span<const float> importance{};
};

/// Sums over points of the area that each stands for, times importance and irradiance; per band.
struct ErrorSampleSums {
  Spectrum light;    ///< irradiance of the points
  Spectrum surplus;  ///< irradiance of the points less that of the patches
  Spectrum off;      ///< sum of |point - patch|
  Spectrum noise;    ///< the part of `off` due to sampling: half the difference of the two halves
  /// Sum of the squares of what the points add to `surplus`: no less than the variance of that.
  Spectrum surplus_variance{};
};
/// Adds the sums of a part (a cluster, a rank).
void add(ErrorSampleSums& sums, const ErrorSampleSums& part);

/// Points on one receiving cluster, which get the light of one shooting cluster after the other.
class ErrorSamples {
 public:
  ErrorSamples(const ClusterState& receiver, const Occluders& occluders,
               const ErrorSampleConfig& config, WorkCount& work);

  /// Returns the clusters that may matter to the points, ascending: those that rays met, and those
  /// of the far field that may send enough light.
  std::vector<ClusterId> shooters(const FarView& far) const;
  /// Adds the irradiance of the points by a light.
  void add(const LightSource& light);
  /// Adds the irradiance of the points by a cluster; each cluster may be added once.
  void add(const ClusterState& shooter);
  /// Compares the points' irradiance with that of the receiver's patches.
  ErrorSampleSums compare(const ClusterState& receiver) const;

 private:
  /// Floor of the reference irradiance, relative to the scene's mean.
  static constexpr double least_irradiance = 1e-3;
  /// Polygons that may bring a smaller share of a point's light than this are left to the rays.
  static constexpr double least_share = 5e-3;
  /// The same for bright emitters.
  static constexpr double least_bright_share = 1e-6;

  struct Point {
    std::uint32_t polygon;
    Vec3 x, n;
    double area_m2;                       ///< area that it stands for, times its importance
    double irradiance;                    ///< of the patch there, before this gather; largest band
    std::array<Spectrum, 2> light;        ///< irradiance so far, by both halves of the rays
    std::vector<VisibleNode> controlled;  ///< nodes of the present shooter that are in closed form
    double controlled_factor = 0.0;       ///< sum of these nodes' form factors, over all shooters
    std::array<double, 2> controlled_rays{};  ///< share of the rays of a half that met such nodes
    /// Radiosity times the ray's share, summed over both halves of the rays. uncontrolled_light:
    /// over the rays that met no such node; ray_light: over all rays that met no bright emitter.
    Spectrum uncontrolled_light{}, ray_light{};
  };
  struct Hit {
    PolygonRef polygon;
    std::uint32_t point;
    int half;
    Vec3 y;
    std::uint32_t passage = 0;  ///< number in passages_
  };
  void place(const ClusterState& receiver);
  void cast_rays();
  void add_ray(std::uint32_t point, const Vec3& d, int half);
  /// Returns the irradiance that a contribution is compared with.
  double reference_irradiance(const Point& point) const {
    return std::max(point.irradiance, least_irradiance * config_.mean_irradiance);
  }
  double unoccluded_share(const PatchForest& forest, std::uint32_t polygon,
                          const Point& point) const;
  bool is_bright(const PatchForest& forest, std::size_t polygon, const Point& point) const;
  /// Returns the radiosity above which a polygon is bright.
  double bright_radiosity(const Point& point) const;
  void add_shooters(const FarView& far, const Point& point, std::vector<ClusterId>& found) const;
  void add_closed_forms(const ClusterState& shooter, Point& point);
  void add_emitter(const ClusterState& shooter, std::uint32_t polygon, Point& point);
  double irradiance_of(const Point& point, std::size_t half, std::size_t band) const;

  const Occluders* occluders_;
  ErrorSampleConfig config_;
  WorkCount* work_;
  ClusterId receiver_;
  std::size_t bands_;
  Random random_;
  std::vector<Point> points_;
  std::vector<Hit>
      hits_;  ///< ends of all rays on front sides, and panes' on their ways; by cluster
  std::vector<Passage> passages_{Passage{}};  ///< the first: nothing stands between
  VisibleNodes visible_nodes_;
};

}  // namespace enfilade
