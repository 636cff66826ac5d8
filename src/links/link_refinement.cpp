#include "links/link_refinement.hpp"

namespace enfilade {
namespace {

/// A group receives as one only where this share of the power bound is below the tolerance: its
/// transport is rough.
constexpr double receiving_group_share = 0.1;
/// A group shoots as one, where that matters, with at most so many polygons: each costs a form
/// factor at each of the receiver's points.
constexpr std::uint32_t most_shooting_polygons = 32;
/// An opening is halved at most so often.
constexpr int finest_light_part = 16;
/// A far node whose power matters shoots as one from at least so many of its radii away.
constexpr double far_gap = 2.0;
/// A far node that surrounds or touches the receiver is opened unless its power is below this share
/// of the tolerance.
constexpr double surrounding_share = 0.1;

}  // namespace

LinkRefinement::LinkRefinement(ClusterState& receiver, std::span<const LightSource> lights,
                               const FarView* far, const Occluders& occluders,
                               const RefinementConfig& config, WorkCount& work)
    : receiver_(receiver),
      lights_(lights),
      far_(far),
      config_(config),
      work_(work),
      estimator_(occluders, config.visibility, work),
      importance_(receiver, occluders, config.importance),
      oracle_(refinement_oracle(config.oracle)) {}

LinkSide LinkRefinement::shooter_side(const Link& link, const PatchForest* shooter,
                                      const LinkSide& receiver) const {
  if (link.is_far()) return LinkSide::of(*far_, link.shooter.group(), receiver);
  if (link.is_light()) return LinkSide::of(lights_[link.shooter.root], link.shooter);
  return LinkSide::of(*shooter, link.shooter_cluster, link.shooter);
}

NodeLight LinkRefinement::light_of(const Link& link, const PatchForest* shooter) const {
  if (link.is_far()) {
    return NodeLight::of(far_->light(), link.shooter.group(),
                         unfold_direction({link.shooter_x, link.shooter_y}));
  }
  if (link.is_light()) return NodeLight::of(lights_[link.shooter.root]);
  return NodeLight::of(*shooter, link.shooter);
}

bool LinkRefinement::can_split(const LinkSide& side) const {
  if (side.is_light())
    return !side.part->is_point() && !side.part->light->sky &&
           side.id.path < (1u << finest_light_part);
  if (side.is_group() || side.is_far()) return true;
  return side.id.path < (1u << config_.max_depth) && side.area_m2 > config_.min_area_m2 &&
         side.shape.deviations().y > 0.0;
}

bool LinkRefinement::accurate_enough(const Link& link, std::span<const float> transport,
                                     const PatchForest* shooter) const {
  if (!link.evaluated && link.is_light()) return false;
  if (link.evaluated && link.finest) return true;
  if (link.is_far() && (config_.renew_far || !link.evaluated))
    return far_->light().is_dark(link.shooter.group());
  const NodeLight sent = light_of(link, shooter);
  if (!link.evaluated) return sent.light <= 0.0 && sent.variation <= 0.0;
  return oracle_->estimated_error(link, transport, receiver_.patches(), sent) <=
         tolerance(link.receiver);
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
  const LinkSide shooter = shooter_side(link, shooting, receiver);
  const double tolerance = this->tolerance(link.receiver);
  if (shooter.is_far() && !far_->may_see(shooter.id.group())) return;
  const bool dark = shooter.is_far() ? far_->light().is_dark(shooter.id.group())
                                     : shooter.light <= 0.0 && shooter.variation <= 0.0;
  if (dark) {
    link.evaluated = false;
    kept.add(link, std::vector<float>(kept.stride(), 0.0f));
    return;
  }
  if (!receiver.is_group() && receiver.same_node(shooter)) return;  // a plane does not see itself
  if (LinkEstimator::faces_away(receiver, shooter)) return;
  if (receiver.is_patch() && receiver_.patches().unreachable(receiver.id.root)) return;
  const double bound = LinkEstimator::power_bound(receiver, shooter);
  if (shooter.is_light() && bound <= 0.0) return;  // its beam passes by
  const bool shooter_is_larger = shooter.radius > receiver.radius;
  if (shooter.is_far() && must_open(receiver, shooter, bound)) {
    open(receiver, shooter);
    return;
  }

  if (receiver.is_group() &&
      (receiver.same_node(shooter) || receiving_group_share * bound > tolerance)) {
    const bool shooter_can = shooter.is_group() || shooter.is_far();
    split(receiver, shooter, !(shooter_can && shooter_is_larger) || receiver.same_node(shooter),
          nullptr);
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
    const LinkEstimate anew = estimator_.kept(receiver, shooter, tolerance, among, estimate);
    kept.add(link, {anew.transport.data(), kept.stride()}, anew.tint);
    return;
  }
  bool split_receiver = oracle_->splits_receiver(receiver, shooter, estimate);
  if (split_receiver ? !can_split(receiver) : !can_split(shooter)) split_receiver = !split_receiver;
  if (split_receiver ? !can_split(receiver) : !can_split(shooter)) {
    link.finest = true;
    kept.add(link, transport, estimate.tint);
    return;
  }
  const LinkEstimator::Between between = estimator_.between();
  split(receiver, shooter, split_receiver, between != nullptr ? between : among);
}

/// Where a far node surrounds or touches the receiver, no direction and no distance stands for all
/// of it; and its far-field factor is good enough only where little is at stake, or far away.
bool LinkRefinement::must_open(const LinkSide& receiver, const LinkSide& shooter,
                               double bound) const {
  const double gap = gap_m(receiver.bounds, shooter.bounds);
  const double allowed = tolerance(receiver.id);
  if (gap <= 0.0) return bound > surrounding_share * allowed;
  return bound > allowed && gap < far_gap * shooter.radius;
}

/// Replaces the link to a far node by links to its two halves, or to the cluster that it is.
void LinkRefinement::open(const LinkSide& receiver, const LinkSide& shooter) {
  ++work_.links_refined;
  const BuildingTree::Node& node = far_->tree().node(shooter.id.group());
  Link link;
  link.receiver = receiver.id;
  if (node.leaf()) {
    link.shooter_cluster = node.cluster;
    link.shooter = node.polygons > 1 ? PatchId{PatchId::group_bit, 1} : PatchId{};
    near_links_.push_back(link);
    return;
  }
  for (const std::uint32_t half : {node.right, node.left}) {
    link.shooter = {PatchId::group_bit | half, 1};
    pending_.push_back({link, nullptr});
  }
}

/// Puts the links between the halves of one side and the other side on the list of pending links.
void LinkRefinement::split(const LinkSide& receiver, const LinkSide& shooter, bool split_receiver,
                           const LinkEstimator::Between& between) {
  ++work_.links_refined;
  Link link;
  link.shooter_cluster = shooter.cluster;
  if (!split_receiver && shooter.is_far()) {
    open(receiver, shooter);
    return;
  }
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

/// Copies the estimate's errors, and the shooter's centroid or direction, into the link.
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
  if (shooter.is_far()) {
    const Vec2 folded = fold_direction(shooter.toward);
    link.shooter_x = static_cast<float>(folded.x);
    link.shooter_y = static_cast<float>(folded.y);
  }
  if (!shooter.is_patch()) return;
  link.shooter_x = static_cast<float>(shooter.shape.centroid.x);
  link.shooter_y = static_cast<float>(shooter.shape.centroid.y);
}

}  // namespace enfilade
