#include "links/link_side.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/clip.hpp"

namespace enfilade {
namespace {

/// The shape of patch `id`: of the node itself, or cut out of `node`, its deepest ancestor that has
/// been made.
PatchShape shape_of(const PatchForest& forest, std::size_t node, PatchId id) {
  PatchShape shape = forest.node(node).shape;
  int missing = 0;
  for (std::uint32_t path = id.path; path != forest.node(node).id.path; path >>= 1) ++missing;
  while (missing-- > 0) {
    auto halves = shape.halves(shape.cut(forest.frames()[id.root].lines));
    shape = ((id.path >> missing) & 1u) == 0 ? std::move(halves.first) : std::move(halves.second);
  }
  return shape;
}

/// The largest mean over the bands, and the largest RMS variation (by the gradient and by the
/// node's deviation), over a part s of a node.
NodeLight light_within(const PatchForest& forest, std::size_t node, const PatchShape& s) {
  NodeLight sent;
  const std::span<const double> b = forest.radiosity(node);
  const Vec2 shift = s.centroid - forest.node(node).shape.centroid;
  const auto terms = static_cast<std::size_t>(forest.terms());
  for (std::size_t at = 0; at < b.size(); at += terms) {
    double mean = b[at], variation = 0.0;
    if (terms == 3) {
      const Vec2 g(b[at + 1], b[at + 2]);
      mean += glm::dot(g, shift);
      variation = s.cxx * g.x * g.x + 2.0 * s.cxy * g.x * g.y + s.cyy * g.y * g.y;
    }
    sent.light = std::max(sent.light, std::abs(mean));
    sent.variation = std::max(sent.variation, std::sqrt(std::max(0.0, variation)));
  }
  sent.variation = std::hypot(sent.variation, forest.deviation(node));
  return sent;
}

NodeLight light_of_group(const PatchForest& forest, std::size_t group) {
  NodeLight sent;
  for (const double b : forest.group_radiosity(group)) sent.light = std::max(sent.light, b);
  sent.variation = forest.group_deviation(group);
  return sent;
}

}  // namespace

NodeLight NodeLight::of(const PatchForest& forest, PatchId id) {
  if (id.is_group()) return light_of_group(forest, id.group());
  const std::size_t node = forest.find(id);
  if (forest.node(node).id == id) return light_within(forest, node, forest.node(node).shape);
  return light_within(forest, node, shape_of(forest, node, id));
}

NodeLight NodeLight::of(const LightSource& light) {
  NodeLight sent;
  for (const double i : light.intensity) sent.light = std::max(sent.light, i);
  if (!light.opening.empty()) sent.variation = sent.light;
  return sent;
}

NodeLight NodeLight::of(const BuildingLight& light, std::uint32_t node, const Vec3& w) {
  NodeLight sent;
  sent.light = light.radiosity(node, w);
  sent.variation = light.deviation(node);
  return sent;
}

LinkSide LinkSide::of(const PatchForest& forest, ClusterId cluster, PatchId id) {
  LinkSide side;
  side.forest = &forest;
  side.cluster = cluster;
  side.id = id;
  if (id.is_group()) {
    const GroupNode& group = forest.groups()[id.group()];
    side.bounds = group.bounds;
    side.center = group.bounds.center();
    side.radius = 0.5 * group.bounds.diagonal();
    side.area_m2 = group.area_m2;
    static_cast<NodeLight&>(side) = light_of_group(forest, id.group());
    return side;
  }
  const std::size_t node = forest.find(id);
  side.shape = shape_of(forest, node, id);
  const PolygonFrame& frame = side.frame();
  side.center = frame.at(side.shape.centroid);
  for (const Vec2& p : side.shape.vertices) {
    side.corners.push_back(frame.at(p));
    side.bounds.add(side.corners.back());
    side.radius = std::max(side.radius, glm::length(side.corners.back() - side.center));
  }
  side.area_m2 = side.shape.area_m2;
  static_cast<NodeLight&>(side) = light_within(forest, node, side.shape);
  return side;
}

LinkSide LinkSide::before(const Plane& plane) const {
  LinkSide side = *this;
  side.corners = split(corners, plane, 1e-9 * radius).first;
  PatchOutline vertices;
  for (const Vec3& p : side.corners) vertices.push_back(frame().project(p));
  if (vertices.size() >= 3) side.shape = PatchShape::from(vertices);
  return side;
}

LinkSide LinkSide::of(const LightSource& light, PatchId id) {
  LinkSide side;
  side.id = id;
  side.part = std::make_shared<const LightPart>(LightPart::of(light, id.path));
  side.corners = side.part->corners();
  for (const Vec3& corner : side.corners) side.bounds.add(corner);
  side.center = side.part->center;
  side.radius = side.part->radius;
  static_cast<NodeLight&>(side) = NodeLight::of(light);
  return side;
}

double LinkSide::most_toward(const LinkSide& receiver) const {
  const Vec3 d = receiver.center - center;
  const double distance = glm::length(d), reach = receiver.radius + radius;
  ViewCone cone{Vec3(0.0, 0.0, 1.0), std::numbers::pi};
  if (distance > reach) cone = {d / distance, std::asin(reach / distance)};
  return part->share * most_relative_intensity(*part->light, cone);
}

LinkSide LinkSide::of(const FarView& far, std::uint32_t node, const LinkSide& receiver) {
  LinkSide side;
  side.far = &far;
  side.id = {PatchId::group_bit | node, 1};
  side.bounds = far.tree().node(node).bounds;
  side.center = side.bounds.center();
  side.radius = 0.5 * side.bounds.diagonal();
  const Vec3 d = receiver.center - side.center;
  const double distance = glm::length(d);
  if (distance > 2.0 * side.radius) side.toward = d / distance;
  static_cast<NodeLight&>(side) = NodeLight::of(far.light(), node, side.toward);
  side.area_m2 = far.tree().facing_m2(node, side.toward);
  side.portal_m2 = far.portal_m2(node, receiver.bounds, receiver.area_m2);
  return side;
}

std::uint64_t LinkSide::seed_of(const LinkSide& a, const LinkSide& b) {
  std::uint64_t h = 0x8F1BBCDCull;
  for (const std::uint64_t x :
       {std::uint64_t{a.cluster.value}, std::uint64_t{a.id.root}, std::uint64_t{a.id.path},
        std::uint64_t{b.cluster.value}, std::uint64_t{b.id.root}, std::uint64_t{b.id.path}}) {
    h = (h ^ x) * 0x9E3779B97F4A7C15ull;
    h ^= h >> 29;
  }
  return h;
}

}  // namespace enfilade
