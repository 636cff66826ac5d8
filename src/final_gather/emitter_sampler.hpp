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
  /// What a few rays from a point find of the polygons that are not bright.
  struct Survey {
    struct Seen {
      std::uint32_t polygon;  ///< global number
      int rays = 0;           ///< that end on its front side
      Spectrum radiosity;     ///< sum over the rays' ends
      double square = 0.0;    ///< sum of squares, of the largest band
    };
    int rays = 0;            ///< cast
    std::vector<Seen> seen;  ///< ascending
    /// Mean radiosity per band where rays end on polygons that are not controlled.
    Spectrum mean(const ControlVariate& control, std::size_t bands) const;
  };
  /// Casts `rays` stratified rays over the hemisphere at p.
  Survey survey(const Vec3& p, const Vec3& n, std::uint32_t own, int rays, Random& random) const;

  /// Makes the control variate at p (unit normal n, on polygon `own` or on none) and adds its
  /// integral to `irradiance`, which holds the light of point lights. Controlled are all bright
  /// emitters, and of the others those that may give the share `least` of all
  /// light if nothing hid any, and those of `survey`, with few occluders (VisibleNodes), whose
  /// light would make `rays` rays noisier than `least`, a share of the light at p. A bright emitter
  /// behind many occluders is cut into parts behind few, the smallest of which are sampled by rays;
  /// `variance` gains theirs.
  ControlVariate add_control_variate(const Vec3& p, const Vec3& n, std::uint32_t own,
                                     const Survey& survey, int rays, double least, Random& random,
                                     Spectrum& irradiance, Spectrum& variance) const;

  /// Adds what the control variate's polygons emit themselves, to the irradiance at its point.
  void add_emitted(const ControlVariate& control, Spectrum& irradiance) const;

  /// A bright emitter, or another polygon that gives light.
  struct Emitter {
    std::uint32_t polygon;  ///< global number
    const PatchForest* forest;
    std::uint32_t node;  ///< of the forest; a bright emitter's is its polygon
    Polygon corners;
    double largest_radiosity;  ///< mean over the node, of the largest band
    double size2;              ///< m2: squared distance of its farthest corner from its centroid
    const PatchShape& shape() const { return forest->node(node).shape; }
    const PolygonFrame& frame() const { return forest->frames()[forest->node(node).id.root]; }
    Vec3 center() const { return frame().at(shape().centroid); }
    double radiosity(std::size_t band) const {
      return forest->radiosity(node)[band * static_cast<std::size_t>(forest->terms())];
    }
  };
  std::span<const Emitter> bright() const { return bright_; }
  /// The irradiance (largest band) that each of bright() would give at p if nothing hid it.
  std::vector<double> bright_unoccluded(const Vec3& p, const Vec3& n, std::uint32_t own) const {
    return unoccluded(bright_, p, n, own);
  }

 private:
  /// The other polygons of a cluster.
  struct OtherGroup {
    std::size_t begin, end;  ///< of others_
    Box box;
    double power = 0.0;  ///< sum of radiosity (largest band) times area
  };

  static std::vector<double> unoccluded(std::span<const Emitter> polygons, const Vec3& p,
                                        const Vec3& n, std::uint32_t own);
  void add_large_others(const Vec3& p, const Vec3& n, std::uint32_t own, double bright,
                        double least_share, std::vector<std::uint32_t>& polygons) const;
  double control_bright(const Vec3& p, const Vec3& n, std::uint32_t own, double known, double least,
                        Random& random, ControlVariate& control, Spectrum& variance) const;
  void control_others(const Vec3& p, const Vec3& n, std::uint32_t own, const Survey& survey,
                      double most_square, double bright, double least_share, double least,
                      ControlVariate& control) const;
  std::vector<std::uint32_t> noisy_polygons(const Survey& survey, double mean,
                                            double most_square) const;

  std::span<const ClusterState> clusters_;
  const Occluders* occluders_;
  std::vector<Emitter> bright_, others_;  ///< others_: all else that gives light
  std::vector<OtherGroup> groups_;        ///< of others_
  std::vector<bool> is_bright_;           // by global number
};

}  // namespace enfilade
