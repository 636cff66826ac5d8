// A node of a hierarchy, or a light or a part of its opening, as one side of a link: its geometry
// and the light that it sends.
#pragma once

#include <cstdint>
#include <memory>

#include "far_field/far_view.hpp"
#include "geometry/polygon.hpp"
#include "hierarchy/cluster_state.hpp"
#include "light_parts/light_part.hpp"

namespace enfilade {

/// The light that a node sends.
struct NodeLight {
  double light = 0.0;  ///< mean radiosity, worst band (a light's mean intensity)
  /// RMS variation around the mean, worst band. Of a light with an opening its mean intensity: what
  /// a link's variation is relative to.
  double variation = 0.0;

  /// Returns the light of a node; a patch that has not been made sends its ancestor's light.
  static NodeLight of(const PatchForest& forest, PatchId id);
  static NodeLight of(const LightSource& light);
  /// Of a node of the building's tree, towards unit vector w.
  static NodeLight of(const BuildingLight& light, std::uint32_t node, const Vec3& w);
};

/// One side of a link. A patch that its owner has not subdivided is derived from its ancestor: its
/// shape is cut out of the ancestor's, with the ancestor's light.
struct LinkSide : NodeLight {
  const PatchForest* forest = nullptr;  ///< null: a light, or a far node
  const FarView* far = nullptr;         ///< of a far node: a node of the building's tree
  ClusterId cluster;
  PatchId id;
  PatchShape shape;  ///< of a patch
  Polygon corners;   ///< of a patch in space; of a light what its hull contains it
  std::shared_ptr<const LightPart> part;  ///< of a light
  Vec3 center{0.0};
  double radius = 0.0;  ///< of a ball around the centre that contains the side, metres
  Box bounds;
  double area_m2 = 0.0;  ///< of a far node: that faces the receiver
  Vec3 toward{0.0};      ///< from a far node to the receiver; 0 where that is no single direction
  /// Of a far node: the most that its direct exchange area with the receiver can be, by portals.
  double portal_m2 = 0.0;

  bool is_light() const { return forest == nullptr && far == nullptr; }
  bool is_far() const { return far != nullptr; }
  bool is_group() const { return forest != nullptr && id.is_group(); }
  bool is_patch() const { return forest != nullptr && !id.is_group(); }
  const PolygonFrame& frame() const { return forest->frames()[id.root]; }
  Plane plane() const { return {frame().n, glm::dot(frame().n, frame().origin)}; }
  const GroupNode& group() const { return forest->groups()[id.group()]; }
  /// Returns a patch's part in front of the plane; the patch itself where all of it is in front.
  LinkSide before(const Plane& plane) const;
  /// Of a light: returns an upper bound of its intensity towards the receiver, from anywhere on it
  /// to anywhere there, per unit of its mean intensity; times the part's share.
  double most_toward(const LinkSide& receiver) const;
  bool same_node(const LinkSide& o) const { return cluster == o.cluster && id == o.id; }

  /// Returns the seed of the random numbers for a pair of sides: a function of their names alone.
  static std::uint64_t seed_of(const LinkSide& a, const LinkSide& b);
  static LinkSide of(const PatchForest& forest, ClusterId cluster, PatchId id);
  /// Returns light `id.root` or, by the path, a part of it.
  static LinkSide of(const LightSource& light, PatchId id);
  /// Returns a node of the building's tree, as the receiver sees it.
  static LinkSide of(const FarView& far, std::uint32_t node, const LinkSide& receiver);
};

}  // namespace enfilade
