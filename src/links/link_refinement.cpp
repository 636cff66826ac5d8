#include "links/link_refinement.hpp"

namespace enfilade {
namespace {

/// A group receives as one only where this share of the power bound is below the tolerance: its
/// transport is rough.
constexpr double receiving_group_share = 0.1;
/// A group shoots as one, where that matters, with at most so many polygons: each costs a form
/// factor at each of the receiver's points.
constexpr std::uint32_t most_shooting_polygons = 32;

}  // namespace

LinkRefinement::LinkRefinement(ClusterState& receiver, std::span<const PointLight> lights,
                               const Occluders& occluders, const RefinementConfig& config,
                               WorkCount& work)
    : receiver_(receiver),
      lights_(lights),
      config_(config),
      work_(work),
      estimator_(occluders, config.visibility, work),
      oracle_(refinement_oracle(config.oracle)) {}

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

bool LinkRefinement::accurate_enough(const Link& link, std::span<const float> transport,
                                     const PatchForest* shooter) const {
  if (!link.evaluated && link.is_light()) return false;
  if (link.evaluated && link.finest) return true;
  const NodeLight sent = shooter == nullptr ? NodeLight::of(lights_[link.shooter.root])
                                            : NodeLight::of(*shooter, link.shooter);
  if (!link.evaluated) return sent.light <= 0.0 && sent.variation <= 0.0;
  return oracle_->estimated_error(link, transport, receiver_.patches(), sent) <=
         config_.link_tolerance;
}

void LinkRefinement::refine(const Link& link, const PatchForest* shooter, LinkSet& kept) {
  pending_.push_back({link, nullptr});
  while (!pending_.empty()) {
    const Pending next = std::move(pending_.back());
    pending_.pop_back();
    evaluate(next.link, next.among, shooter, kept);
  }
}

void LinkRefinement::evaluate(Link link, const LinkEstimator::Between& among,
                              const PatchForest* shooting, LinkSet& kept) {
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
  if (receiver.is_patch() && receiver_.patches().unreachable(receiver.id.root)) return;
  const double bound = LinkEstimator::power_bound(receiver, shooter);
  const bool shooter_is_larger = shooter.radius > receiver.radius;

  if (receiver.is_group() &&
      (receiver.same_node(shooter) || receiving_group_share * bound > tolerance)) {
    split(receiver, shooter,
          !(shooter.is_group() && shooter_is_larger) || receiver.same_node(shooter), nullptr);
    return;
  }
  if (shooter.is_group() && !receiver.is_group()) {
    const GroupNode& group = shooter.group();
    const bool near_or_many =
        shooter.cluster == receiver.cluster || group.end - group.begin > most_shooting_polygons;
    if (near_or_many && bound > tolerance) {
      split(receiver, shooter, false, nullptr);
      return;
    }
  }
  const LinkEstimate estimate = estimator_.evaluate(receiver, shooter, tolerance, among);
  if (estimate.invisible) return;
  describe(link, shooter, estimate);
  const std::span<const float> transport(estimate.transport.data(), kept.stride());
  if (oracle_->estimated_error(link, transport, receiver_.patches(), shooter) <= tolerance) {
    kept.add(link, transport);
    return;
  }
  bool split_receiver = oracle_->splits_receiver(receiver, shooter, estimate);
  if (split_receiver ? !can_split(receiver) : !can_split(shooter)) split_receiver = !split_receiver;
  if (split_receiver ? !can_split(receiver) : !can_split(shooter)) {
    link.finest = true;
    kept.add(link, transport);
    return;
  }
  const LinkEstimator::Between between = estimator_.between();
  split(receiver, shooter, split_receiver, between != nullptr ? between : among);
}

/// Puts the links between the halves of one side and the other side on the list of pending links.
void LinkRefinement::split(const LinkSide& receiver, const LinkSide& shooter, bool split_receiver,
                           const LinkEstimator::Between& between) {
  ++work_.links_refined;
  Link link;
  link.shooter_cluster = shooter.cluster;
  const LinkSide& side = split_receiver ? receiver : shooter;
  std::array<PatchId, 2> halves;
  if (side.is_group()) {
    halves = {side.group().left_id(), side.group().right_id()};
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
    pending_.push_back({link, between});
  }
}

/// Copies the estimate's errors, and the shooter's centroid, into the link.
void LinkRefinement::describe(Link& link, const LinkSide& shooter, const LinkEstimate& estimate) {
  link.evaluated = true;
  link.finest = false;
  link.error = static_cast<float>(estimate.receiver_error + estimate.shooter_error);
  link.variation = static_cast<float>(estimate.variation);
  link.visibility_uncertainty =
      estimate.shooter_error > 0.0
          ? static_cast<std::uint8_t>(255.0 * estimate.shooter_error /
                                      (estimate.receiver_error + estimate.shooter_error))
          : std::uint8_t{0};
  if (!shooter.is_patch()) return;
  link.shooter_x = static_cast<float>(shooter.shape.centroid.x);
  link.shooter_y = static_cast<float>(shooter.shape.centroid.y);
}

}  // namespace enfilade
