// Importance of each polygon to the light at some points (Smits, Arvo and Salesin 1992): how much
// an error of its irradiance changes theirs. Links are refined by it where only these points are
// asked for.
#pragma once

#include <span>
#include <vector>

#include "base/work_count.hpp"
#include "clusters/cluster.hpp"
#include "occluders/occluders.hpp"
#include "scene/scene.hpp"

namespace enfilade {

struct ImportanceConfig {
  /// Random walks from all points together. Their noise changes where links are fine, never what
  /// they carry.
  int walks = 1 << 16;
  /// Share of the importance that is spread evenly by area: elsewhere the light is rough, but not
  /// missing, and importance that the walks have missed is not zero.
  double everywhere = 0.01;
  /// A polygon's density is drawn towards that of its cluster, as if so many walks had come at the
  /// cluster's density (the mean of a gamma-Poisson posterior).
  double prior_hits = 4.0;
  std::uint64_t seed = 1;
};

/// Returns none where there are no points, else one value per polygon, by its global number in
/// `occluders`: the importance per area of its irradiance, relative to the mean over all area. It
/// is the adjoint solution of the radiosity equation whose source is the cosine-weighted hemisphere
/// of each point, all points alike, times the polygon's reflectance (largest band); by random walks
/// that end by absorption.
std::vector<float> importance_to(std::span<const Probe> points, const Scene& scene,
                                 std::span<const Cluster> clusters, const Occluders& occluders,
                                 WorkCount& work, const ImportanceConfig& config = {});

/// Returns how many of the points no light of the scene's surfaces reaches: they see no front, or
/// backs in more than half of their hemisphere, as within a wall or under a floor. Sky counts as
/// seen.
std::size_t blind_points(std::span<const Probe> points, const Scene& scene,
                         const Occluders& occluders);

}  // namespace enfilade
