// The occluders of a scene: all polygons, for visibility rays and shafts.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "clusters/cluster.hpp"
#include "occluders/panes.hpp"
#include "raycast/ray_scene.hpp"

namespace enfilade {

/// A polygon of a cluster, by number.
struct PolygonRef {
  ClusterId cluster;
  std::uint32_t polygon = 0;  ///< index in Cluster::polygons
};

/// A pane that a ray passes, and what is left of the light that comes from before and from behind
/// it.
struct PaneMet {
  std::uint32_t polygon = RayScene::no_polygon;
  bool front = false;  ///< the ray comes from its front
  double distance_m = 0.0;
  Passage before, behind;
};

/// Farther than anything.
constexpr double far_away_m = 1e30;

class ShaftTree;

/// All polygons of the given clusters. Panes hide nothing: no question about what hides names one,
/// and passage() tells what they let through. Each has a global number: polygon k of cluster c is
/// global(c, k).
class Occluders {
 public:
  explicit Occluders(std::span<const Cluster> clusters);
  ~Occluders();
  Occluders(Occluders&&) noexcept;
  Occluders& operator=(Occluders&&) noexcept;

  const RayScene& rays() const { return rays_; }
  std::uint32_t global(ClusterId cluster, std::uint32_t polygon) const {
    return first_[cluster.index()] + polygon;
  }
  PolygonRef local(std::uint32_t global) const { return refs_[global]; }
  /// True where it is certain that no polygon other than skip_a and skip_b meets the convex hull of
  /// a and b (shaft culling, Haines and Wallace 1991).
  bool shaft_open(const Polygon& a, const Polygon& b, std::uint32_t skip_a,
                  std::uint32_t skip_b) const;
  /// Writes the polygons other than skip_a and skip_b that meet the convex hull of a and b into
  /// `found`; false where there are more than `most`.
  bool find_between(const Polygon& a, const Polygon& b, std::uint32_t skip_a, std::uint32_t skip_b,
                    std::size_t most, std::vector<std::uint32_t>& found) const;
  /// The same search among `among`, the result of find_between for two polygons that contain a and
  /// b.
  void find_among(std::span<const std::uint32_t> among, const Polygon& a, const Polygon& b,
                  std::uint32_t skip_a, std::uint32_t skip_b,
                  std::vector<std::uint32_t>& found) const;
  const Polygon& polygon(std::uint32_t global) const;
  const Panes& panes() const { return panes_; }
  /// Returns what passes from a to b, which may lie on the polygons skip_a and skip_b: by one ray
  /// against walls and panes.
  Passage passage(const Vec3& a, const Vec3& b, std::uint32_t skip_a, std::uint32_t skip_b,
                  RayStart start = RayStart::on_polygon) const;
  /// Returns what the panes pass along a ray of this length, which no wall stops.
  Passage dimmed(const Vec3& from, const Vec3& direction, double distance_m, std::uint32_t skip,
                 RayStart start = RayStart::on_polygon) const;
  /// Returns the panes that such a ray passes, nearest first, the backs of two-sided ones among
  /// them.
  std::vector<PaneMet> panes_along(const Vec3& from, const Vec3& direction, double distance_m,
                                   std::uint32_t skip, RayStart start = RayStart::on_polygon) const;
  /// Replaces `found` by the panes other than skip_a and skip_b that meet the convex hull of a and
  /// b.
  void panes_between(const Polygon& a, const Polygon& b, std::uint32_t skip_a, std::uint32_t skip_b,
                     std::vector<std::uint32_t>& found) const;
  /// A point at most this far from a plane lies on the plane, for shafts and shadows.
  double tolerance_m() const { return 1e-7 * extent_m_; }
  /// True where it is certain that polygon `blocker` (convex) meets every segment between a and b.
  bool shaft_shut(const Polygon& a, const Polygon& b, std::uint32_t blocker) const;
  /// Returns the polygons that pass within reach_m of p, in ascending order.
  std::vector<std::uint32_t> touching(const Vec3& p, double reach_m) const;
  /// Returns the diagonal of the box around all polygons.
  double extent_m() const { return extent_m_; }
  /// Returns the bytes in memory, roughly.
  std::size_t bytes() const;

 private:
  std::vector<std::uint32_t> first_;
  std::vector<PolygonRef> refs_;
  Panes panes_;
  RayScene rays_;
  std::unique_ptr<ShaftTree> shafts_;
  double extent_m_ = 0.0;
};

}  // namespace enfilade
