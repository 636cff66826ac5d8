// Rays against polygons: the only room that knows Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/geometry.hpp"
#include "geometry/polygon.hpp"

namespace enfilade {

/// The first polygon that a ray meets.
struct RayHit {
  std::uint32_t polygon = 0xFFFFFFFFu;  ///< index into the polygons given; none = nothing was hit
  double distance_m = 0.0;
  bool front = false;  ///< the ray came from the side that the polygon's normal points to
  bool any() const { return polygon != 0xFFFFFFFFu; }
};

/// A pane that a ray passes.
struct PaneCrossing {
  std::uint32_t polygon = 0xFFFFFFFFu;  ///< index into the polygons given
  double distance_m = 0.0;
  double cosine = 1.0;  ///< between the ray and the pane's normal, against each other: above 0
                        ///< where the ray comes from its front
};

/// Where a ray begins: on a polygon, with others perhaps in the same place, or in the air (lifted
/// off by twice `epsilon_m()`), where all that lies ahead counts, however near.
enum class RayStart { on_polygon, in_air };

/// Convex polygons in an Embree BVH, in robust mode, with coordinates shifted to their centre so
/// that single precision is relative to the scene's size and not to its place. Polygons block from
/// both sides. Queries change nothing, and may come from several threads.
class RayScene {
 public:
  static constexpr std::uint32_t no_polygon = 0xFFFFFFFFu;

  /// A ray, and the polygon that it passes through.
  struct Ray {
    Vec3 from{0.0};
    Vec3 direction{0.0, 0.0, 1.0};  ///< of any length
    std::uint32_t skip = no_polygon;
    double max_distance_m = 1e30;
  };
  /// A segment, and the two polygons that it passes through: those that its ends lie on.
  struct Sight {
    Vec3 a{0.0}, b{0.0};
    std::uint32_t skip_a = no_polygon, skip_b = no_polygon;
  };

  /// Throws RunError where Embree cannot start or lacks memory.
  /// `panes`: 1 for each polygon that light passes: rays meet those in crossings() alone. Empty:
  /// there are none.
  explicit RayScene(std::span<const Polygon> polygons, std::span<const char> panes = {});
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// True where a polygon lies between a and b, other than those numbered skip_a and skip_b.
  bool occluded(const Vec3& a, const Vec3& b, std::uint32_t skip_a = no_polygon,
                std::uint32_t skip_b = no_polygon, RayStart start = RayStart::on_polygon) const;
  /// Answers `occluded` for each segment: blocked[i] is 1 where segment i is blocked, else 0. Both
  /// spans have the same size.
  void occluded(std::span<const Sight> segments, std::span<std::uint8_t> blocked,
                RayStart start = RayStart::on_polygon) const;

  /// Returns the first hit from `from` along `direction`, skipping polygon `skip`. Of polygons in
  /// one place, one that shows its front. None where the direction has no length, as from a point
  /// to itself.
  RayHit closest(const Vec3& from, const Vec3& direction, std::uint32_t skip = no_polygon,
                 double max_distance_m = 1e30, RayStart start = RayStart::on_polygon) const;
  /// The first hit of each ray; both spans have the same size.
  void closest(std::span<const Ray> rays, std::span<RayHit> hits,
               RayStart start = RayStart::on_polygon) const;

  /// True where there are panes.
  bool has_panes() const;
  /// Replaces `found` by the panes that a ray passes within max_distance_m, nearest first, other
  /// than those numbered skip_a and skip_b.
  void crossings(const Vec3& from, const Vec3& direction, double max_distance_m,
                 std::uint32_t skip_a, std::uint32_t skip_b, RayStart start,
                 std::vector<PaneCrossing>& found) const;

  /// Rays are blind this close to an end on a polygon: about the single-precision step at the
  /// scene's extent.
  double epsilon_m() const;
  /// Returns the memory of the BVH and of what is kept beside it, estimated.
  std::size_t bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace enfilade
