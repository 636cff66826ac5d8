#include "gather/gather.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "coarse/aggregate_flow.hpp"
#include "gather/row_closure.hpp"

namespace enfilade {
namespace {

/// One gather of one receiving cluster, one shooting cluster after the other.
class Gatherer {
 public:
  Gatherer(ClusterState& receiver, std::span<const PointLight> lights, const Occluders& occluders,
           const GatherConfig& config)
      : receiver_(receiver),
        lights_(lights),
        occluders_(occluders),
        config_(config),
        bands_(static_cast<std::size_t>(receiver.bands())),
        terms_(static_cast<std::size_t>(receiver.patches().terms())),
        first_time_(receiver.iteration() == 0),
        refinement_(receiver, lights, occluders, config.refinement, result_.figures.work),
        closure_(receiver),
        samples_(receiver, occluders, config.error_samples, result_.figures.work),
        kept_(receiver.links().stride()),
        light_(bands_ * terms_),
        means_(bands_),
        flow_(bands_) {
    result_.figures.direct_power.assign(bands_, 0.0);
    result_.figures.returning_power.assign(bands_, 0.0);
    result_.figures.uncertain_power.assign(bands_, 0.0);
  }

  void from_lights();
  void from(const ClusterState& shooter);
  GatherResult finish();

 private:
  void link_root(ClusterId cluster, PatchId shooter);
  void take_links(ClusterId cluster, const ClusterState* shooter, bool stale);
  void receive(const Link& link, std::span<const float> transport, const PatchForest* shooter,
               AggregateFlow* flow);
  double read_light(const Link& link, const PatchForest* shooter);
  void receive_group(const Link& link, std::span<const float> transport);
  void receive_patch(const Link& link, std::span<const float> transport);
  std::vector<double> arriving_power() const;
  Spectrum gathered_power() const;
  void close_rows();
  void push_pull();

  ClusterState& receiver_;
  std::span<const PointLight> lights_;
  const Occluders& occluders_;
  const GatherConfig& config_;
  std::size_t bands_, terms_;
  bool first_time_;
  GatherResult result_;
  LinkRefinement refinement_;
  RowClosure closure_;
  ErrorSamples samples_;
  std::size_t next_ = 0;  ///< link that has not had its turn; they lie in the shooters' order
  LinkSet kept_;          ///< links after refinement, once one of them has changed
  bool changed_ = false;
  std::vector<double> gathered_;       ///< irradiance at every node, indexed like the light
  std::vector<double> light_, means_;  ///< of the link at hand: as the basis has it; per band
  std::vector<double> flow_;           ///< per band: power by reflection, of the link at hand
};

/// First link: the whole receiving cluster from a whole visible cluster, or from a light.
void Gatherer::link_root(ClusterId cluster, PatchId shooter) {
  Link link;
  link.receiver = receiver_.patches().root();
  link.shooter_cluster = cluster;
  link.shooter = shooter;
  receiver_.links().add(link, std::vector<float>(kept_.stride(), 0.0f));
}

void Gatherer::from_lights() {
  if (first_time_) {
    for (std::uint32_t i = 0; i < lights_.size(); ++i) link_root({}, {i, 1});
  }
  for (const PointLight& light : lights_) samples_.from(light);
  take_links({}, nullptr, false);
}

void Gatherer::from(const ClusterState& shooter) {
  if (first_time_) link_root(shooter.id(), shooter.patches().root());
  if (config_.close_rows) closure_.see(shooter);
  samples_.from(shooter);
  const bool itself = shooter.id() == receiver_.id();
  take_links(shooter.id(), &shooter, itself || shooter.iteration() < config_.iteration);
}

/// Refines the links from one cluster, then gathers over what they became.
void Gatherer::take_links(ClusterId cluster, const ClusterState* state, bool stale) {
  const PatchForest* shooter = state == nullptr ? nullptr : &state->patches();
  const LinkSet& links = receiver_.links();
  const std::size_t begin = next_, kept_begin = changed_ ? kept_.size() : begin;
  while (next_ < links.size() && links[next_].shooter_cluster == cluster) ++next_;
  if (config_.refine) {
    for (std::size_t i = begin; i < next_; ++i) {
      if (refinement_.accurate_enough(links[i], links.transport(i), shooter)) {
        if (changed_) kept_.add(links[i], links.transport(i));
        continue;
      }
      if (!changed_) kept_.take_first(links, i);
      changed_ = true;
      refinement_.refine(links[i], shooter, kept_);
    }
  }
  const LinkSet& now = changed_ ? kept_ : links;
  const std::size_t end = changed_ ? kept_.size() : next_;
  gathered_.resize(receiver_.patches().size() * bands_ * terms_, 0.0);
  std::optional<AggregateFlow> flow;
  if (shooter != nullptr && config_.coarse_row)
    flow.emplace(receiver_.patches(), receiver_.aggregates(), *shooter, state->aggregates());
  bool any = false;
  for (std::size_t i = kept_begin; i < end; ++i) {
    if (!now[i].evaluated) continue;
    receive(now[i], now.transport(i), shooter, flow ? &*flow : nullptr);
    any = true;
  }
  if (any && flow) result_.coarse.entries.push_back({cluster, stale, flow->take()});
}

/// Sets light_ to what the shooter sends, as the link's transport takes it; returns its variation.
double Gatherer::read_light(const Link& link, const PatchForest* shooter) {
  std::fill(light_.begin(), light_.end(), 0.0);
  if (shooter == nullptr) {
    for (std::size_t b = 0; b < bands_; ++b) {
      light_[b * terms_] = lights_[link.shooter.root].intensity[b];
    }
    return 0.0;
  }
  if (link.shooter.is_group()) {
    const std::span<const double> mean = shooter->group_radiosity(link.shooter.group());
    for (std::size_t b = 0; b < bands_; ++b) light_[b * terms_] = mean[b];
    return shooter->group_deviation(link.shooter.group());
  }
  const std::size_t node = shooter->find(link.shooter);
  const std::span<const double> radiosity = shooter->radiosity(node);
  std::copy(radiosity.begin(), radiosity.end(), light_.begin());
  if (terms_ == 3 && shooter->node(node).id != link.shooter) {
    const Vec2 shift = Vec2(link.shooter_x, link.shooter_y) - shooter->node(node).shape.centroid;
    for (std::size_t t = 0; t < light_.size(); t += 3) {
      light_[t] += light_[t + 1] * shift.x + light_[t + 2] * shift.y;
    }
  }
  return shooter->deviation(node);
}

void Gatherer::receive(const Link& link, std::span<const float> transport,
                       const PatchForest* shooter, AggregateFlow* flow) {
  const double variation = read_light(link, shooter);
  double top = 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    means_[b] = light_[b * terms_];
    top = std::max(top, std::abs(means_[b]));
  }
  result_.figures.link_error_power += link.error * top + link.variation * variation;
  result_.figures.visibility_uncertainty_power += link.visibility_error() * top;
  ++result_.figures.work.links_gathered;
  const double factor = area_factor(receiver_.patches(), link, transport);
  if (shooter == nullptr) {
    for (std::size_t b = 0; b < bands_; ++b) result_.figures.direct_power[b] += factor * means_[b];
  } else {
    for (std::size_t b = 0; b < bands_; ++b) {
      flow_[b] = factor * (means_[b] - shooter->exitance(link.shooter, b));
      result_.figures.returning_power[b] += flow_[b];
    }
    if (flow != nullptr) flow->add(link, transport, flow_);
  }
  if (config_.close_rows) closure_.add(link, transport, means_, variation);
  link.receiver.is_group() ? receive_group(link, transport) : receive_patch(link, transport);
}

/// A group's beam goes to its polygons: each gets the cosine's share of what a facing plane would.
void Gatherer::receive_group(const Link& link, std::span<const float> transport) {
  for_each_facing(receiver_.patches(), link, transport, [&](std::uint32_t k, double cosine) {
    for (std::size_t b = 0; b < bands_; ++b) {
      gathered_[(k * bands_ + b) * terms_] += transport[0] * cosine * means_[b];
    }
  });
}

void Gatherer::receive_patch(const Link& link, std::span<const float> transport) {
  double* to = gathered_.data() + receiver_.patches().find(link.receiver) * bands_ * terms_;
  for (std::size_t b = 0; b < bands_; ++b) {
    for (std::size_t r = 0; r < terms_; ++r) {
      double sum = 0.0;
      for (std::size_t s = 0; s < terms_; ++s)
        sum += transport[r * terms_ + s] * light_[b * terms_ + s];
      to[b * terms_ + r] += sum;
    }
  }
}

GatherResult Gatherer::finish() {
  ENFILADE_CHECK(next_ == receiver_.links().size(), "links of a cluster that is not visible");
  // Before its first gather the receiver had none; and a link that was refined may have come back
  // as it was.
  const LinkSet& links = changed_ ? kept_ : receiver_.links();
  result_.links_changed =
      first_time_ ? links.size() > 0 : changed_ && !(links == receiver_.links());
  if (changed_) receiver_.links() = std::move(kept_);
  gathered_.resize(receiver_.patches().size() * bands_ * terms_, 0.0);
  if (config_.close_rows) close_rows();
  push_pull();
  result_.figures.error_samples = samples_.compare(receiver_);
  result_.figures.patches = receiver_.patches().size();
  result_.figures.links = receiver_.links().size();
  receiver_.set_iteration(config_.iteration);
  return std::move(result_);
}

/// What was gathered at every node so far, but for what came straight from point lights.
Spectrum Gatherer::gathered_power() const {
  const PatchForest& patches = receiver_.patches();
  Spectrum power(bands_, 0.0);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    for (std::size_t b = 0; b < bands_; ++b) {
      power[b] += patches.node(n).shape.area_m2 * gathered_[(n * bands_ + b) * terms_];
    }
  }
  for (std::size_t b = 0; b < bands_; ++b) power[b] -= result_.figures.direct_power[b];
  return power;
}

/// What is added to the rows came from all of the shooters, as far as the coarse system can tell.
void Gatherer::close_rows() {
  const Spectrum before = gathered_power();
  closure_.close(occluders_, config_.flux_correction, result_.figures.work, gathered_);
  result_.figures.uncertain_power = closure_.uncertain_power();
  const Spectrum after = gathered_power();
  for (std::size_t b = 0; b < bands_; ++b) {
    if (before[b] <= 0.0 || after[b] <= 0.0) continue;
    const double more = after[b] / before[b];
    result_.figures.returning_power[b] *= more;
    for (CoarseRow::Entry& entry : result_.coarse.entries) {
      for (std::size_t i = b; i < entry.flow.size(); i += bands_) entry.flow[i] *= more;
    }
  }
}

/// [aggregate * bands + band]
std::vector<double> Gatherer::arriving_power() const {
  const PatchForest& patches = receiver_.patches();
  std::vector<double> sums(receiver_.aggregates().size() * bands_, 0.0), power(bands_);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    if (!patches.node(n).leaf()) continue;
    for (std::size_t b = 0; b < bands_; ++b) {
      power[b] = patches.node(n).shape.area_m2 * patches.irradiance(n)[b * terms_];
    }
    receiver_.aggregates().add(patches, patches.node(n).id, power, sums);
  }
  return sums;
}

/// Pushes and pulls what was gathered, and measures what changed.
void Gatherer::push_pull() {
  PatchForest& patches = receiver_.patches();
  const std::vector<double> before(patches.radiosities().begin(), patches.radiosities().end());
  std::vector<double> received(bands_, 0.0), change(bands_, 0.0);
  result_.coarse.before = arriving_power();
  patches.push_pull(gathered_);
  result_.figures.work.push_pulls += patches.size();
  result_.figures.absorbed_power.assign(bands_, 0.0);
  result_.figures.escaping_power.assign(bands_, 0.0);
  const std::size_t aggregates = result_.coarse.aggregates = receiver_.aggregates().size();
  result_.coarse.absorbed.assign(aggregates * bands_, 0.0);
  result_.coarse.escaping.assign(aggregates * bands_, 0.0);
  Spectrum absorbed(bands_), escaping(bands_);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const PatchNode& node = patches.node(n);
    if (!node.leaf()) continue;
    for (std::size_t b = 0; b < bands_; ++b) {
      const double delta =
          std::abs(patches.radiosity(n)[b * terms_] - before[(n * bands_ + b) * terms_]);
      const double power = node.shape.area_m2 * patches.irradiance(n)[b * terms_];
      result_.figures.max_change = std::max(result_.figures.max_change, delta);
      change[b] += node.shape.area_m2 * delta;
      received[b] += power;
      const double reflectance = patches.frames()[node.id.root].reflectance[b];
      absorbed[b] = (1.0 - reflectance) * power;
      escaping[b] = 0.0;
      result_.figures.absorbed_power[b] += absorbed[b];
      if (patches.enclosed_share(n) >= 0.0f) {
        const double share = 1.0 - static_cast<double>(patches.enclosed_share(n));
        result_.figures.escaping_power[b] +=
            share * node.shape.area_m2 * patches.radiosity(n)[b * terms_];
        escaping[b] = share * reflectance * power;
      }
    }
    receiver_.aggregates().add(patches, node.id, absorbed, result_.coarse.absorbed);
    receiver_.aggregates().add(patches, node.id, escaping, result_.coarse.escaping);
  }
  result_.coarse.after = arriving_power();
  result_.figures.arriving_power = received;
  result_.figures.received_power = *std::max_element(received.begin(), received.end());
  result_.figures.change_power = *std::max_element(change.begin(), change.end());
}

}  // namespace

GatherResult gather(ClusterState& receiver, std::span<const ClusterId> visible,
                    const ShooterSource& shooter, std::span<const PointLight> lights,
                    const Occluders& occluders, const GatherConfig& config) {
  Gatherer gatherer(receiver, lights, occluders, config);
  gatherer.from_lights();
  for (const ClusterId id : visible) {
    gatherer.from(id == receiver.id() ? receiver : shooter(id));
  }
  return gatherer.finish();
}

Spectrum emitted_power(const Scene& scene, std::span<const Cluster> clusters) {
  Spectrum power(static_cast<std::size_t>(scene.bands), 0.0);
  for (const Cluster& c : clusters) {
    for (const ClusterPolygon& p : c.polygons) {
      const double area = area_m2(p.polygon);
      const Spectrum& exitance = scene.surfaces[p.surface.index()].exitance;
      for (std::size_t b = 0; b < power.size(); ++b) power[b] += area * exitance[b];
    }
  }
  for (const PointLight& light : scene.lights) {
    for (std::size_t b = 0; b < power.size(); ++b) {
      power[b] += 4.0 * std::numbers::pi * light.intensity[b];
    }
  }
  return power;
}

}  // namespace enfilade
