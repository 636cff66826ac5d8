// The polygons that a hemisphere of rays would find too seldom for what they give: lamps, windows.
#pragma once

#include <span>
#include <vector>

#include "base/random.hpp"
#include "final_gather/visible_nodes.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// Those whose mean radiosity is over 8 times the mean of all surfaces (so none in a furnace).
/// Their light at a point is had by closed form and visibility rays. Refers to what it is made of.
class EmitterSampler {
 public:
  EmitterSampler(std::span<const ClusterState> clusters, const Occluders& occluders);

  bool contains(std::uint32_t polygon) const { return is_bright_[polygon]; }
  /// Adds to `irradiance` what all of them give at p, by their affine radiosities, and those of all
  /// others that may give `least` of the light there (a share) and are hidden by few; of what an
  /// affine function leaves out as much those of its parts. Exactly, but for bright ones that many
  /// hide: these are looked at as closely as they matter. `own`: the polygon that p lies on. What
  /// is added for a direction is what was counted there, else `ambient`: rays have to find the
  /// rest.
  struct ControlledPolygon {
    std::uint32_t polygon;
    std::vector<VisibleNode> nodes;
  };
  struct ControlVariate {
    std::vector<ControlledPolygon> polygons;  ///< ascending
    Spectrum ambient;                         ///< mean radiosity of those in view that were not
    const ControlledPolygon* find(std::uint32_t polygon) const;
  };
  ControlVariate add_largest(const Vec3& p, const Vec3& n, std::uint32_t own, double least,
                             Spectrum& irradiance) const;

  /// How likely each is to be picked for points near p.
  std::vector<double> weights_near(const Vec3& p) const;
  /// Adds share * the irradiance that one of them gives at p, picked by `weights` (running sums),
  /// by one ray; its mean over many picks is that of all.
  void add_one(const Vec3& p, const Vec3& n, std::uint32_t own, std::span<const double> weights,
               Random& random, std::span<const double> share, Spectrum& irradiance) const;

 private:
  struct Bright {
    std::uint32_t polygon;  // global number
    const PatchForest* forest;
    std::uint32_t k;
    Polygon corners;
    double top;  // mean radiosity, worst band
    double radiosity(std::size_t band) const {
      return forest->radiosity(k)[band * static_cast<std::size_t>(forest->terms())];
    }
  };
  static std::vector<double> weights(const std::vector<Bright>& polygons, const Vec3& p,
                                     const Vec3& n, std::uint32_t own);
  Spectrum ambient(std::span<const double> weights, const ControlVariate& counted,
                   std::size_t bands) const;
  void add_visible(const Vec3& p, const Vec3& n, std::uint32_t own, const Bright& b,
                   const PatchShape& shape, double threshold, int depth, VisibleNode& sum) const;

  std::span<const ClusterState> clusters_;
  const Occluders* occluders_;
  std::vector<Bright> bright_, others_;
  std::vector<bool> is_bright_;
};

}  // namespace enfilade
