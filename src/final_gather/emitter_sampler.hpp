// Sampling of the polygons that rays would find too rarely for the light they give: lamps, windows.
#pragma once

#include <span>
#include <vector>

#include "base/random.hpp"
#include "final_gather/visible_nodes.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// A bright emitter is a polygon whose mean radiosity is over 8 times the mean of all surfaces (so
/// that there is none in a furnace). Its light at a point comes from closed forms and visibility
/// rays, never from a hemisphere of rays. Refers to the clusters and occluders that it is made of.
class EmitterSampler {
 public:
  EmitterSampler(std::span<const ClusterState> clusters, const Occluders& occluders);

  /// True where the polygon (global number) is a bright emitter.
  bool contains(std::uint32_t polygon) const { return is_bright_[polygon]; }

  /// A polygon whose contribution at a point is integrated in closed form, over its visible nodes'
  /// affine radiosities.
  struct ControlledPolygon {
    std::uint32_t polygon;  ///< global number
    std::vector<VisibleNode> nodes;
  };
  /// The function of direction that is integrated at a point without rays: the affine radiosity of
  /// a controlled polygon's node where that is seen, `ambient` elsewhere. Rays estimate the
  /// integral of the true radiosity less this function (a control variate).
  struct ControlVariate {
    std::vector<ControlledPolygon> polygons;  ///< ascending
    Spectrum ambient;                         ///< mean radiosity of the other polygons in view
    const ControlledPolygon* find(std::uint32_t polygon) const;
  };
  /// Makes the control variate at p (unit normal n, on polygon `own` or on none) and adds its
  /// integral to `irradiance`. Controlled are all bright emitters, and the other polygons that may
  /// give the share `least` of the light at p and have few occluders (VisibleNodes). A bright
  /// emitter behind many occluders is cut into parts behind few, the smallest of which are sampled
  /// by rays; `variance` gains theirs.
  ControlVariate add_control_variate(const Vec3& p, const Vec3& n, std::uint32_t own, double least,
                                     Random& random, Spectrum& irradiance,
                                     Spectrum& variance) const;

  /// Adds what the control variate's polygons emit themselves, to the irradiance at its point.
  void add_emitted(const ControlVariate& control, Spectrum& irradiance) const;

  /// Running sums of the bright emitters' probabilities, not normalised, to be picked for points
  /// near p.
  std::vector<double> pick_weights(const Vec3& p) const;
  /// Adds an estimate, by one ray, of share * the irradiance that all bright emitters give at p:
  /// one of them is picked by `weights`. Unbiased for their mean radiosities.
  void add_picked(const Vec3& p, const Vec3& n, std::uint32_t own, std::span<const double> weights,
                  Random& random, std::span<const double> share, Spectrum& irradiance) const;

 private:
  struct Emitter {
    std::uint32_t polygon;  // global number
    const PatchForest* forest;
    std::uint32_t k;  // number in the forest
    Polygon corners;
    double largest_radiosity;  // mean over the polygon, of the largest band
    double size2;              // m2: squared distance of its farthest corner from its centroid
    double radiosity(std::size_t band) const {
      return forest->radiosity(k)[band * static_cast<std::size_t>(forest->terms())];
    }
  };
  static std::vector<double> unoccluded(const std::vector<Emitter>& polygons, const Vec3& p,
                                        const Vec3& n, std::uint32_t own);
  Spectrum ambient(std::span<const double> unoccluded, const ControlVariate& control,
                   std::size_t bands) const;

  std::span<const ClusterState> clusters_;
  const Occluders* occluders_;
  std::vector<Emitter> bright_, others_;  // others_: all else that gives light
  std::vector<bool> is_bright_;           // by global number
};

}  // namespace enfilade
