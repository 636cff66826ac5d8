#include "radiosity/link_refinement.hpp"

namespace enfilade {

LinkRefinement::LinkRefinement(ClusterState& receiver, std::span<const PointLight> lights,
                               const Occluders& occluders, const RefinementConfig& config,
                               WorkCount& work)
    : receiver_(receiver),
      lights_(lights),
      config_(config),
      work_(work),
      estimator_(occluders, work) {}

LinkSide LinkRefinement::shooter_side(const Link& link, const PatchForest* shooter) const {
  return shooter == nullptr ? LinkSide::of(lights_[link.shooter.root], link.shooter.root)
                            : LinkSide::of(*shooter, link.shooter_cluster, link.shooter);
}

bool LinkRefinement::can_split(const LinkSide& side) const {
  if (side.is_light()) return false;
  if (side.is_group()) return true;
  return side.id.path < (1u << config_.max_depth) && side.area_m2 > config_.min_area_m2 &&
         side.shape.deviations().y > 0.0;
}

bool LinkRefinement::fine_as_it_is(const Link& link, const PatchForest* shooter) const {
  if (!link.evaluated && link.is_light()) return false;
  if (link.evaluated && link.finest) return true;
  const LinkSide side = shooter_side(link, shooter);
  if (!link.evaluated) return side.light <= 0.0 && side.variation <= 0.0;
  return link.error * side.light + link.variation * side.variation <= config_.link_tolerance;
}

bool LinkRefinement::refine(const Link& link, std::span<const float> transport,
                            const PatchForest* shooter, LinkSet& kept) {
  if (fine_as_it_is(link, shooter)) {
    kept.add(link, transport);
    return false;
  }
  pending_.push_back(link);
  while (!pending_.empty()) {
    const Link next = pending_.back();
    pending_.pop_back();
    evaluate(next, shooter, kept);
  }
  return true;
}

void LinkRefinement::evaluate(Link link, const PatchForest* shooting, LinkSet& kept) {
  const LinkSide receiver = LinkSide::of(receiver_.patches(), receiver_.id(), link.receiver);
  const LinkSide shooter = shooter_side(link, shooting);
  const double tolerance = config_.link_tolerance;
  if (shooter.light <= 0.0 && shooter.variation <= 0.0) {
    link.evaluated = false;
    kept.add(link, std::vector<float>(kept.stride(), 0.0f));
    return;
  }
  if (!receiver.is_group() && receiver.same_node(shooter)) return;  // a plane does not see itself
  if (LinkEstimator::faces_away(receiver, shooter)) return;
  double bound = LinkEstimator::power_bound(receiver, shooter);
  // None of 64 rays found a front side: no more than about 1 in 64 of the hemisphere can be one.
  if (receiver.is_patch() && receiver_.patches().sealed(receiver.id.root)) bound /= 64.0;
  const bool shooter_is_larger = shooter.radius > receiver.radius;

  // A group receives as one only where that can matter little; it shoots as one where it is not
  // large.
  if (receiver.is_group() && (receiver.same_node(shooter) || 0.1 * bound > tolerance)) {
    split(receiver, shooter,
          !(shooter.is_group() && shooter_is_larger) || receiver.same_node(shooter));
    return;
  }
  if (shooter.is_group() && !receiver.is_group()) {
    const GroupNode& group = shooter.group();
    const bool near_or_many = shooter.cluster == receiver.cluster || group.end - group.begin > 32;
    if (near_or_many && bound > tolerance) {
      split(receiver, shooter, false);
      return;
    }
  }
  const LinkEstimate estimate = estimator_.evaluate(receiver, shooter, tolerance);
  if (estimate.invisible) return;
  const double variation_error = estimate.variation * shooter.variation;
  const double error =
      (estimate.receiver_error + estimate.shooter_error) * shooter.light + variation_error;
  if (error <= tolerance) {
    accept(link, shooter, estimate, false, kept);
    return;
  }
  bool split_receiver = splits_receiver(receiver, shooter, estimate, variation_error);
  if (split_receiver ? !can_split(receiver) : !can_split(shooter)) split_receiver = !split_receiver;
  if (split_receiver ? !can_split(receiver) : !can_split(shooter)) {
    accept(link, shooter, estimate, true, kept);
    return;
  }
  split(receiver, shooter, split_receiver);
}

/// The side that dominates; where visibility alone is in doubt, the larger one.
bool LinkRefinement::splits_receiver(const LinkSide& receiver, const LinkSide& shooter,
                                     const LinkEstimate& estimate, double variation_error) const {
  const bool shooter_is_larger = shooter.radius > receiver.radius;
  const double receiver_error = estimate.receiver_error * shooter.light;
  const double shooter_error = estimate.shooter_error * shooter.light + variation_error;
  if (receiver.is_group()) return !(shooter.is_group() && shooter_is_larger);
  if (shooter.is_group() && receiver_error < shooter_error) return false;
  return receiver_error > shooter_error ||
         (receiver_error > 0.25 * shooter_error && !shooter_is_larger) ||
         (variation_error < 0.5 * shooter_error && !shooter_is_larger);
}

/// Puts the links between the halves of one side and the other side on the list.
void LinkRefinement::split(const LinkSide& receiver, const LinkSide& shooter, bool split_receiver) {
  ++work_.links_refined;
  Link link;
  link.shooter_cluster = shooter.cluster;
  const LinkSide& side = split_receiver ? receiver : shooter;
  std::array<PatchId, 2> halves;
  if (side.is_group()) {
    const GroupNode& group = side.group();
    auto id = [](std::int32_t child) {
      return child >= 0 ? PatchId{PatchId::group_bit + static_cast<std::uint32_t>(child), 1}
                        : PatchId{static_cast<std::uint32_t>(~child), 1};
    };
    halves = {id(group.left), id(group.right)};
  } else {
    halves = {side.id.child(0), side.id.child(1)};
    if (split_receiver) {
      PatchForest& patches = receiver_.patches();
      const std::size_t node = patches.find(side.id);
      if (patches.node(node).leaf()) {
        patches.subdivide(node);
        work_.patches += 2;
      }
    }
  }
  for (const PatchId half : {halves[1], halves[0]}) {
    link.receiver = split_receiver ? half : receiver.id;
    link.shooter = split_receiver ? shooter.id : half;
    pending_.push_back(link);
  }
}

void LinkRefinement::accept(Link link, const LinkSide& shooter, const LinkEstimate& estimate,
                            bool finest, LinkSet& kept) {
  link.evaluated = true;
  link.finest = finest;
  link.error = static_cast<float>(estimate.receiver_error + estimate.shooter_error);
  link.variation = static_cast<float>(estimate.variation);
  link.doubt = estimate.shooter_error > 0.0
                   ? static_cast<std::uint8_t>(255.0 * estimate.shooter_error /
                                               (estimate.receiver_error + estimate.shooter_error))
                   : std::uint8_t{0};
  if (shooter.is_patch()) {
    link.shooter_x = static_cast<float>(shooter.shape.centroid.x);
    link.shooter_y = static_cast<float>(shooter.shape.centroid.y);
  }
  kept.add(link, std::span<const float>(estimate.transport.data(), kept.stride()));
}

}  // namespace enfilade
