#include "gather/gather.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "coarse/aggregate_flow.hpp"
#include "gather/gathered_light.hpp"
#include "gather/push_pull.hpp"
#include "gather/row_closure.hpp"
#include "hierarchy/link_errors.hpp"

namespace enfilade {
namespace {

/// One gather of one receiving cluster, one shooting cluster after the other.
class Gatherer {
 public:
  Gatherer(ClusterState& receiver, const Shooters& shooters, std::span<const LightSource> lights,
           const Occluders& occluders, const GatherConfig& config)
      : receiver_(receiver),
        shooters_(shooters),
        lights_(lights),
        occluders_(occluders),
        config_(config),
        bands_(static_cast<std::size_t>(receiver.bands())),
        first_time_(receiver.iteration() == 0),
        refinement_(receiver, lights, far_view(), occluders, config.refinement,
                    result_.figures.work),
        light_(receiver.patches(), lights, far_light()),
        closure_(receiver, far_light(), config.openness_rays),
        samples_(receiver, occluders, config.error_samples, result_.figures.work),
        refined_(receiver.links().stride()),
        flow_(bands_),
        reflected_(bands_) {
    result_.figures.direct_power.assign(bands_, 0.0);
    result_.figures.returning_power.assign(bands_, 0.0);
    result_.figures.uncertain_power.assign(bands_, 0.0);
  }

  void gather_lights();
  void gather_far();
  /// Returns the clusters to gather from, ascending; those of the links to far nodes that were
  /// opened among them.
  std::vector<ClusterId> clusters();
  void gather_from(const ClusterState& shooter);
  GatherResult finish();

 private:
  const FarView* far_view() const { return far_ ? &*far_ : nullptr; }
  const BuildingLight* far_light() const { return far_ ? &far_->light() : nullptr; }
  void link_root(ClusterId cluster, PatchId shooter);
  void refine_links(std::size_t begin, std::size_t end, const PatchForest* shooter);
  void refine_near_links(ClusterId cluster, const PatchForest& shooter);
  void begin_change(std::size_t links_before);
  void take_links(ClusterId cluster, const ClusterState* shooter, bool stale);
  void receive(const LinkSet& links, std::size_t i, const PatchForest* from, AggregateFlow* flow);
  void close_rows();

  ClusterState& receiver_;
  const Shooters& shooters_;
  std::span<const LightSource> lights_;
  const Occluders& occluders_;
  const GatherConfig& config_;
  std::size_t bands_;
  bool first_time_;
  std::optional<FarView> far_{shooters_.far == nullptr
                                  ? std::nullopt
                                  : std::make_optional<FarView>(*shooters_.far, receiver_.id())};
  GatherResult result_;
  LinkRefinement refinement_;
  GatheredLight light_;
  RowClosure closure_;
  ErrorSamples samples_;
  std::size_t next_ = 0;  ///< first link of the shooters to come; links lie in the shooters' order
  LinkErrors link_errors_;
  LinkSet refined_;           ///< the links of the shooters so far, once one of them has changed
  bool changed_ = false;      ///< one has
  std::vector<double> flow_;  ///< scratch: reflected power per band that one link brings
  std::vector<double> reflected_;  ///< scratch: reflected radiosity per band of a far shooter
  std::optional<FarFlow> far_flow_;
  std::size_t next_near_ = 0;  ///< first of the refinement's near links that is to come
};

/// Adds the first link, from a whole visible cluster or a light to the whole receiving cluster.
void Gatherer::link_root(ClusterId cluster, PatchId shooter) {
  Link link;
  link.receiver = receiver_.patches().root();
  link.shooter_cluster = cluster;
  link.shooter = shooter;
  receiver_.links().add(link, std::vector<float>(refined_.stride(), 0.0f));
}

void Gatherer::gather_lights() {
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    if (shooters_.shut_out(lights_[i])) continue;
    if (first_time_) link_root({}, {i, 1});
    samples_.add(lights_[i]);
  }
  take_links({}, nullptr, false);
}

void Gatherer::gather_far() {
  if (!far_) return;
  if (first_time_) link_root({}, {PatchId::group_bit | BuildingTree::root, 1});
  const LinkSet& links = receiver_.links();
  const std::size_t first = next_, refined_first = changed_ ? refined_.size() : first;
  while (next_ < links.size() && links[next_].is_far()) ++next_;
  if (config_.refine) refine_links(first, next_, nullptr);
  if (config_.coarse_row) far_flow_.emplace(receiver_.patches(), receiver_.aggregates());
  const LinkSet& now = changed_ ? refined_ : links;
  const std::size_t end = changed_ ? refined_.size() : next_;
  for (std::size_t i = refined_first; i < end; ++i)
    if (now[i].evaluated) receive(now, i, nullptr, nullptr);
  std::vector<Link>& near = refinement_.near_links();
  std::stable_sort(near.begin(), near.end(), [](const Link& a, const Link& b) {
    return a.shooter_cluster < b.shooter_cluster;
  });
}

std::vector<ClusterId> Gatherer::clusters() {
  if (!far_) return {shooters_.listed.begin(), shooters_.listed.end()};
  std::vector<ClusterId> found = samples_.shooters(*far_);
  const LinkSet& links = receiver_.links();
  for (std::size_t i = next_; i < links.size(); ++i) {
    if (found.empty() || found.back() != links[i].shooter_cluster)
      found.push_back(links[i].shooter_cluster);
  }
  for (const Link& link : refinement_.near_links()) found.push_back(link.shooter_cluster);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void Gatherer::gather_from(const ClusterState& shooter) {
  if (first_time_ && !far_) link_root(shooter.id(), shooter.patches().root());
  if (config_.close_rows) closure_.add_shooter(shooter);
  samples_.add(shooter);
  const bool itself = shooter.id() == receiver_.id();
  take_links(shooter.id(), &shooter, itself || shooter.iteration() < config_.iteration);
}

/// From the first link that is replaced by others, all links are copied to refined_: first the
/// `links_before` it.
void Gatherer::begin_change(std::size_t links_before) {
  if (!changed_) refined_.take_first(receiver_.links(), links_before);
  changed_ = true;
}

/// Evaluates and refines the links from this cluster that replace links from far nodes.
void Gatherer::refine_near_links(ClusterId cluster, const PatchForest& shooter) {
  const std::vector<Link>& near = refinement_.near_links();
  for (; next_near_ < near.size() && near[next_near_].shooter_cluster == cluster; ++next_near_) {
    begin_change(next_);
    refinement_.refine(near[next_near_], &shooter, refined_);
  }
}

void Gatherer::refine_links(std::size_t begin, std::size_t end, const PatchForest* shooter) {
  const LinkSet& links = receiver_.links();
  for (std::size_t i = begin; i < end; ++i) {
    const bool dark = links[i].is_light() && shooters_.shut_out(lights_[links[i].shooter.root]);
    if (!dark && refinement_.accurate_enough(links[i], links.transport(i), shooter)) {
      if (changed_) refined_.add_from(links, i);
      continue;
    }
    begin_change(i);
    if (!dark) refinement_.refine(links[i], shooter, refined_);
  }
}

/// Refines the links from one cluster (or from the lights: `state` is null), then gathers over
/// them. `stale`: the cluster's light is that of the iteration before.
void Gatherer::take_links(ClusterId cluster, const ClusterState* state, bool stale) {
  const PatchForest* shooter = state == nullptr ? nullptr : &state->patches();
  const LinkSet& links = receiver_.links();
  const std::size_t first = next_, refined_first = changed_ ? refined_.size() : first;
  while (next_ < links.size() && links[next_].shooter_cluster == cluster && !links[next_].is_far())
    ++next_;
  if (config_.refine) refine_links(first, next_, shooter);
  if (shooter != nullptr) refine_near_links(cluster, *shooter);
  const LinkSet& now = changed_ ? refined_ : links;
  const std::size_t end = changed_ ? refined_.size() : next_;
  std::optional<AggregateFlow> flow;
  if (shooter != nullptr && config_.coarse_row)
    flow.emplace(receiver_.patches(), receiver_.aggregates(), *shooter, state->aggregates());
  bool any = false;
  for (std::size_t i = refined_first; i < end; ++i) {
    if (!now[i].evaluated) continue;
    receive(now, i, shooter, flow ? &*flow : nullptr);
    any = true;
  }
  if (any && flow) result_.coarse.entries.push_back({cluster, stale, flow->take()});
}

void Gatherer::receive(const LinkSet& links, std::size_t i, const PatchForest* shooter,
                       AggregateFlow* flow) {
  const Link& link = links[i];
  const std::span<const float> transport = links.transport(i);
  const double variation = light_.read(link, links.tint(i), shooter);
  const std::span<const double> means = light_.means();
  const double top = light_.most();
  const double importance = refinement_.importance(link.receiver);
  const double error = link.error * top + link.variation * variation;
  link_errors_.add(receiver_.patches(), link, error);
  result_.figures.link_error_power += importance * error;
  result_.figures.visibility_uncertainty_power += importance * link.visibility_error() * top;
  ++result_.figures.work.links_gathered;
  const double factor = area_factor(receiver_.patches(), link, transport);
  std::span<const double> reflected;
  if (link.is_far()) {
    reflected = reflected_;
    for (std::size_t b = 0; b < bands_; ++b) {
      reflected_[b] = light_.reflected(b);
      flow_[b] = factor * reflected_[b];
      result_.figures.returning_power[b] += flow_[b];
    }
    if (far_flow_) far_flow_->add(link, transport, flow_);
  } else if (shooter == nullptr) {
    for (std::size_t b = 0; b < bands_; ++b) result_.figures.direct_power[b] += factor * means[b];
  } else {
    for (std::size_t b = 0; b < bands_; ++b) {
      flow_[b] = factor * (means[b] - light_.tinted(shooter->exitance(link.shooter, b), b));
      result_.figures.returning_power[b] += flow_[b];
    }
    if (flow != nullptr) flow->add(link, transport, flow_);
  }
  if (config_.close_rows) closure_.add(link, transport, means, reflected, variation);
  light_.receive(link, transport);
}

GatherResult Gatherer::finish() {
  ENFILADE_CHECK(next_ == receiver_.links().size(), "links of a cluster that is not visible");
  // A link that was refined may have come back as it was.
  const LinkSet& links = changed_ ? refined_ : receiver_.links();
  result_.links_changed =
      first_time_ ? links.size() > 0 : changed_ && !(links == receiver_.links());
  if (changed_) receiver_.links() = std::move(refined_);
  if (far_flow_) result_.coarse.far = far_flow_->entries(*shooters_.unknowns);
  if (config_.close_rows) close_rows();
  push_pull(receiver_, light_.irradiance(), config_, result_.figures, result_.coarse);
  link_errors_.set(receiver_.patches());
  result_.figures.error_samples = samples_.compare(receiver_);
  result_.figures.patches = receiver_.patches().size();
  result_.figures.links = receiver_.links().size();
  result_.figures.linked_clusters = linked_clusters(receiver_.links(), receiver_.id());
  receiver_.set_iteration(config_.iteration);
  if (far_) result_.light = light_of(receiver_);
  return std::move(result_);
}

/// The light that the closure adds is taken to come from all reflecting shooters in proportion.
void Gatherer::close_rows() {
  const auto reflected_power = [this] {
    Spectrum power = light_.power();
    for (std::size_t b = 0; b < bands_; ++b) power[b] -= result_.figures.direct_power[b];
    return power;
  };
  const Spectrum before = reflected_power();
  RowClosureSums sums = closure_.close(occluders_, config_.flux_correction, result_.figures.work,
                                       light_.irradiance());
  result_.figures.uncertain_power = std::move(sums.uncertain_power);
  result_.figures.rows = std::move(sums.rows);
  const Spectrum after = reflected_power();
  for (std::size_t b = 0; b < bands_; ++b) {
    if (before[b] <= 0.0 || after[b] <= 0.0) continue;
    const double more = after[b] / before[b];
    result_.figures.returning_power[b] *= more;
    for (CoarseRow::Entry& entry : result_.coarse.entries) {
      for (std::size_t i = b; i < entry.flow.size(); i += bands_) entry.flow[i] *= more;
    }
    for (std::size_t i = b; i < result_.coarse.far.flows.size(); i += bands_)
      result_.coarse.far.flows[i] *= more;
  }
}

}  // namespace

GatherResult gather(ClusterState& receiver, const Shooters& shooters, const ShooterSource& shooter,
                    std::span<const LightSource> lights, const Occluders& occluders,
                    const GatherConfig& config) {
  Gatherer gatherer(receiver, shooters, lights, occluders, config);
  gatherer.gather_lights();
  gatherer.gather_far();
  for (const ClusterId id : gatherer.clusters()) {
    gatherer.gather_from(id == receiver.id() ? receiver : shooter(id));
  }
  return gatherer.finish();
}

}  // namespace enfilade
