// Samples of the light of a far node (a node of the building's tree, whose polygons are not in
// memory) at a point of a receiver.
#pragma once

#include <cstdint>

#include "base/random.hpp"
#include "far_field/far_view.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// A point of a far node with the irradiance that it stands for at a receiver's point; a factor of
/// 0 where the sample found none.
struct FarSample {
  Vec3 y{0.0};
  std::uint32_t polygon = 0;  ///< global number
  // As if nothing stood between: the form factor, and the irradiance by what is emitted and by what
  // is reflected, worst band.
  double factor = 0.0, emitted = 0.0, reflected = 0.0;
};

/// Draws a cluster of the node by its share of the light and of the area that it turns to x
/// (FarView::pick_cluster), a polygon by its share of the cluster's, then a point on it, uniformly.
/// What stands between is not looked at. Unbiased by itself, but that no sample stands for a form
/// factor above 1; `with_rays`: unbiased together with end_of_ray(), panes being drawn here alone.
FarSample point_of_node(const FarView& far, std::uint32_t node, const Vec3& x, const Vec3& n,
                        double pick, bool with_rays, const Occluders& occluders, Random& random);

/// The front side of the node, if any, that a ray from x (on polygon `own`) to d meets; d is drawn
/// in proportion to its cosine with n. Panes are looked through, and their tint is not counted.
/// Each sample of a node that is around x is one point and one ray, weighted by the balance
/// heuristic (Veach and Guibas 1995): lamps are found by points, and what is so near that a point
/// of it would stand for more than all light is found by rays.
FarSample end_of_ray(const FarView& far, std::uint32_t node, const Vec3& x, const Vec3& n,
                     const Vec3& d, std::uint32_t own, const Occluders& occluders);

}  // namespace enfilade
