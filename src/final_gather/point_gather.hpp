// Irradiance at a point by one gather from the solution: probes, and the pixels of a picture.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

struct PointGatherConfig {
  std::optional<int> rays{};  ///< in a set, over the hemisphere; none: by `patch_error`
  /// A point gets further sets of rays, up to 16, while their noise (standard error) is above this
  /// share of its light and above 2e-5 of the mean irradiance. By default: above that share of its
  /// light and of a fiftieth of the mean irradiance; up to twice as much, where a quarter of the
  /// reflected light's error is more. 0 = one set.
  std::optional<double> noise{};
  std::uint64_t seed = 1;
  /// Relative error of the light of patches. The larger it is, the farther away a patch must be for
  /// a path to end with its light.
  double patch_error = 0.01;
  /// Relative standard deviation of the reflected light at a point, by the error of the patches
  /// that it comes from.
  double reflected_error = 0.0;

  /// `rays`, or by default from 4096 where the patches are right to 1% down to 512 where they are
  /// right to 3%: what few rays meet then adds less than the error of the patches does.
  int rays_in_set() const {
    const double finer = 0.01 / patch_error;
    return rays.value_or(static_cast<int>(std::clamp(4096.0 * finer * finer, 512.0, 4096.0)));
  }
  /// `noise`, or by default half of `patch_error` and at most 0.005: less noise would not make the
  /// answer better than the patches are, more would make it worse.
  double least_noise() const { return noise.value_or(std::clamp(0.5 * patch_error, 3e-4, 0.005)); }
};

/// The light at a point.
struct PointIrradiance {
  Spectrum irradiance;  ///< per band
  /// Per band, one standard deviation: noise of the rays, and the error of the reflected light.
  Spectrum error;
  /// Per band, the part of `error` that is noise of the rays: independent from point to point,
  /// where the error of the reflected light may be common to all points.
  Spectrum noise;
  /// Per band, the part of `irradiance` that comes straight from point lights and emitting
  /// surfaces; without those that give too small a share of it to be integrated in closed form.
  Spectrum direct;
  double front_share = 0.0;  ///< of the rays, that ended on front sides
  double back_share = 0.0;   ///< of the rays, that ended on back sides
};

/// Refers to the clusters (in order of their ids), lights and occluders, which must outlive it.
class PointGather {
 public:
  PointGather(std::span<const ClusterState> clusters, std::span<const LightSource> lights,
              const Occluders& occluders, const PointGatherConfig& config);
  ~PointGather();

  /// Returns the light at p on a plane with unit normal n, by one gather from every visible patch.
  PointIrradiance at(const Vec3& p, const Vec3& n) const;
  Spectrum irradiance(const Vec3& p, const Vec3& n) const { return at(p, n).irradiance; }
  /// Returns the irradiance per band that the patch's basis has at p: of the patch that p lies on,
  /// else of the one below p (against n). Zero where there is none.
  Spectrum from_patches(const Vec3& p, const Vec3& n) const;
  /// Returns the radiosity per band of polygon `polygon` (global number) at point p on it.
  Spectrum radiosity(std::uint32_t polygon, const Vec3& p) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace enfilade
