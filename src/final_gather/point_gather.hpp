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
  int rays = 4096;  ///< over the hemisphere
  /// Where their noise (standard error) is above this share of a point's light and 1e-4 of the mean
  /// irradiance, as many again, up to 16 times. 0 = never.
  std::optional<double> noise{};
  std::uint64_t seed = 1;
  /// Relative error of what is read off the patches. The larger it is, the farther away a patch has
  /// to be for its own light to be taken.
  double patch_error = 0.01;

  /// `noise`, or by default half of `patch_error` and at most 0.005: what the patches are known to
  /// is not to be lost in noise, and rays would be lost on patches that are known no better.
  double least_noise() const { return noise.value_or(std::clamp(0.5 * patch_error, 3e-4, 0.005)); }
};

/// Holds on to the clusters (in order of their ids), lights and occluders, which must outlive it.
class PointGather {
 public:
  PointGather(std::span<const ClusterState> clusters, std::span<const PointLight> lights,
              const Occluders& occluders, const PointGatherConfig& config);
  ~PointGather();

  /// Irradiance per band at p on a plane with unit normal n, by a gather from every patch in view.
  Spectrum irradiance(const Vec3& p, const Vec3& n) const;
  /// Irradiance per band as the patch's own basis has it at p: the nearest surface below p (against
  /// n).
  Spectrum from_patches(const Vec3& p, const Vec3& n) const;
  /// Radiosity per band of polygon `polygon` (global number) at point p on it.
  Spectrum radiosity(std::uint32_t polygon, const Vec3& p) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace enfilade
