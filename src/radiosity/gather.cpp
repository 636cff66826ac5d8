#include "radiosity/gather.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.hpp"
#include "base/random.hpp"
#include "radiosity/link_estimate.hpp"

namespace enfilade {
namespace {

/// One gather of one receiving cluster.
class Gatherer {
 public:
  Gatherer(ClusterState& receiver, std::span<const ClusterState* const> shooters,
           std::span<const PointLight> lights, const Occluders& occluders,
           const GatherConfig& config)
      : receiver_(receiver),
        lights_(lights),
        occluders_(occluders),
        config_(config),
        estimator_(occluders, result_.work) {
    shooters_[receiver.id()] = {&receiver.patches(), true, {}};
    for (const ClusterState* s : shooters) {
      shooters_[s->id()] = {&s->patches(), s->iteration() < config.iteration, {}};
    }
  }

  GatherResult run() {
    if (receiver_.links().size() == 0) {
      look_around();
      link_roots();
    }
    if (config_.refine) refine_links();
    collect();
    return std::move(result_);
  }

 private:
  struct Shooter {
    const PatchForest* patches = nullptr;
    bool stale = true;             ///< its values are from before this iteration
    std::vector<double> coupling;  ///< per band, for the coarse correction
  };

  void look_around();
  double exposure_of(const PatchNode& node, int rings, bool lit_only);
  double close_rows(std::vector<double>& gathered);
  void couple(const Link& link, std::span<const float> transport);
  void fill_coarse_row(std::span<const double> before, double closing);
  void link_roots();
  void refine_links();
  void refine(Link link, LinkSet& kept);
  void split(const LinkSide& receiver, const LinkSide& shooter, bool split_receiver);
  void accept(Link link, const LinkSide& shooter, const LinkEstimate& estimate, bool finest,
              LinkSet& kept);
  void collect();
  void push_beam(const Link& link, std::span<const float> transport, std::span<const double> light,
                 std::vector<double>& gathered) const;
  bool can_split(const LinkSide& side) const;
  const PatchForest& forest(ClusterId cluster) const {
    const auto found = shooters_.find(cluster);
    ENFILADE_CHECK(found != shooters_.end(), "cluster " + std::to_string(cluster.value));
    return *found->second.patches;
  }
  LinkSide shooter_side(const Link& link) const {
    return link.is_light()
               ? LinkSide::of(lights_[link.shooter.root], link.shooter.root)
               : LinkSide::of(forest(link.shooter_cluster), link.shooter_cluster, link.shooter);
  }
  LinkSide receiver_side(const Link& link) const {
    return LinkSide::of(receiver_.patches(), receiver_.id(), link.receiver);
  }

  ClusterState& receiver_;
  std::span<const PointLight> lights_;
  const Occluders& occluders_;
  const GatherConfig& config_;
  GatherResult result_;
  LinkEstimator estimator_;
  std::map<ClusterId, Shooter> shooters_;
  std::vector<Link> pending_;
};

/// Share of the hemisphere's rays from all over a patch that end on a front side (that gives
/// light). `rings` * `rings` strata from each quarter of the patch.
double Gatherer::exposure_of(const PatchNode& node, int rings, bool lit_only) {
  const PolygonFrame& frame = receiver_.patches().frames()[node.id.root];
  const std::uint32_t own = occluders_.global(receiver_.id(), node.id.root);
  Random random((std::uint64_t{own} << 32) + node.id.path);
  int ended = 0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (int stratum = 0; stratum < rings * rings; ++stratum) {
      const Vec2 q = node.shape.point_in_quarter(quarter, random.uniform(), random.uniform());
      const double r = std::sqrt((stratum / rings + random.uniform()) / rings);
      const double phi = 2.0 * std::numbers::pi * (stratum % rings + random.uniform()) / rings;
      const Vec3 d = r * std::cos(phi) * frame.u + r * std::sin(phi) * frame.v +
                     std::sqrt(std::max(0.0, 1.0 - r * r)) * frame.n;
      ++result_.work.rays;
      const RayHit hit = occluders_.rays().closest(frame.at(q), d, own);
      if (!hit.any() || !hit.front) continue;
      const PolygonRef ref = occluders_.local(hit.polygon);
      const auto seen = shooters_.find(ref.cluster);
      if (seen == shooters_.end()) continue;
      ended += lit_only && seen->second.patches->radiosity(ref.polygon)[0] <= 0.0 ? 0 : 1;
    }
  }
  return ended / (4.0 * rings * rings);
}

/// Finds the polygons that are sealed off, before anything is linked to them.
void Gatherer::look_around() {
  PatchForest& patches = receiver_.patches();
  for (std::size_t k = 0; k < patches.polygons(); ++k) {
    if (exposure_of(patches.node(k), 4, false) == 0.0) patches.seal(k);
  }
}

/// Adds to each leaf what its row of form factors lacks (or has too much) of the share that it must
/// sum to. Returns the closed rows' sum over that of the rows as they were.
double Gatherer::close_rows(std::vector<double>& gathered) {
  PatchForest& patches = receiver_.patches();
  const auto bands = static_cast<std::size_t>(patches.bands());
  const auto terms = static_cast<std::size_t>(patches.terms());
  // Per node: the row's sum as an affine function, the links' doubt, and their light weighted by
  // it.
  const std::size_t width = terms + 1 + bands;
  std::vector<double> rows(patches.size() * width, 0.0);
  const LinkSet& links = receiver_.links();
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    if (!link.evaluated || link.is_light()) continue;
    const std::span<const float> transport = links.transport(i);
    const PatchForest& from = forest(link.shooter_cluster);
    auto light = [&](std::size_t b) {
      return link.shooter.is_group() ? from.group_radiosity(link.shooter.group())[b]
                                     : from.radiosity(from.find(link.shooter))[b * terms];
    };
    auto add = [&](std::size_t node, double factor, double doubt) {
      double* row = rows.data() + node * width;
      row[0] += factor;
      row[terms] += doubt;
      for (std::size_t b = 0; b < bands; ++b) row[terms + 1 + b] += doubt * light(b);
    };
    if (link.receiver.is_group()) {
      const GroupNode& group = patches.groups()[link.receiver.group()];
      for (std::uint32_t j = group.begin; j < group.end; ++j) {
        const std::uint32_t k = patches.order()[j];
        const double cosine =
            glm::dot(patches.frames()[k].n, Vec3(transport[1], transport[2], transport[3]));
        if (cosine > 0.0) add(k, transport[0] * cosine, transport[0] * cosine * 0.3);
      }
      continue;
    }
    const std::size_t node = patches.find(link.receiver);
    // A link that nothing came through takes no share: what is missing comes from where light is
    // seen.
    add(node, transport[0],
        transport[0] > 0.0f ? link.error / patches.node(node).shape.area_m2 : 0.0);
    if (terms == 3) {
      rows[node * width + 1] += transport[3];
      rows[node * width + 2] += transport[6];
    }
  }
  // Push the rows down; at a leaf share out what is missing.
  std::vector<char> open(patches.polygons(), 0);
  // At least 512 rays for the cluster: a narrow opening must not pass for none.
  const std::size_t leaves = patches.polygons() + (patches.size() - patches.polygons()) / 2;
  const int rings = std::max(4, static_cast<int>(std::sqrt(128.0 / static_cast<double>(leaves))));
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const PatchNode& node = patches.node(n);
    if (node.leaf()) {
      if (patches.exposure(n) < 0.0f) {
        patches.set_exposure(n, static_cast<float>(exposure_of(node, rings, true)));
      }
      if (patches.exposure(n) < 1.0f) open[node.id.root] = 1;
      continue;
    }
    for (int side = 0; side < 2; ++side) {
      const std::size_t c = static_cast<std::size_t>(node.first_child + side);
      const double* parent = rows.data() + n * width;
      double* row = rows.data() + c * width;
      for (std::size_t t = 0; t < width; ++t) row[t] += parent[t];
      if (terms == 3) {
        const Vec2 shift = patches.node(c).shape.centroid - node.shape.centroid;
        row[0] += parent[1] * shift.x + parent[2] * shift.y;
      }
    }
  }
  const std::size_t stride = bands * terms;
  const double rays = 4.0 * rings * rings;
  double sum = 0.0, closed = 0.0;
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const PatchNode& node = patches.node(n);
    const double* row = rows.data() + n * width;
    if (!node.leaf()) continue;
    sum += node.shape.area_m2 * row[0];
    closed += node.shape.area_m2 * row[0];
    if (row[terms] <= 0.0) continue;
    const double target = patches.exposure(n);
    // Rays tell an open row's sum to within `blur`, the links to within their doubt: weigh one
    // against the other. A row without an opening sums to 1.
    const double doubt = 0.5 * row[terms];
    const double blur = (target * (1.0 - target) + 1.0 / rays) / rays;
    const double gain = open[node.id.root] ? doubt * doubt / (doubt * doubt + blur) : 1.0;
    const double missing = gain * (target - row[0]);
    if (target <= 0.0) continue;
    closed += node.shape.area_m2 * missing;
    for (std::size_t b = 0; b < bands; ++b) {
      double* to = gathered.data() + n * stride + b * terms;
      const double light = row[terms + 1 + b] / row[terms];
      to[0] += missing * light;
      if (terms == 3) {
        to[1] -= gain * row[1] * light;
        to[2] -= gain * row[2] * light;
      }
    }
  }
  return sum > 0.0 ? closed / sum : 1.0;
}

/// Counts a link in the coarse system: sum of A F rho between its clusters.
void Gatherer::couple(const Link& link, std::span<const float> transport) {
  if (link.is_light()) return;
  const PatchForest& patches = receiver_.patches();
  Shooter& shooter = shooters_.find(link.shooter_cluster)->second;
  const auto bands = static_cast<std::size_t>(patches.bands());
  shooter.coupling.resize(bands, 0.0);
  double area_factor = 0.0;
  if (link.receiver.is_group()) {
    const GroupNode& group = patches.groups()[link.receiver.group()];
    const Vec3 toward(transport[1], transport[2], transport[3]);
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const std::uint32_t k = patches.order()[i];
      if (patches.sealed(k)) continue;
      const double cosine = std::max(0.0, glm::dot(patches.frames()[k].n, toward));
      area_factor += patches.node(k).shape.area_m2 * cosine * transport[0];
    }
  } else {
    area_factor = patches.node(patches.find(link.receiver)).shape.area_m2 * transport[0];
  }
  if (link.shooter.is_group()) {
    const GroupNode& group = shooter.patches->groups()[link.shooter.group()];
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      const std::uint32_t k = shooter.patches->order()[i];
      const double share = shooter.patches->node(k).shape.area_m2 / group.area_m2;
      for (std::size_t b = 0; b < bands; ++b) {
        shooter.coupling[b] += area_factor * share * shooter.patches->frames()[k].reflectance[b];
      }
    }
    return;
  }
  for (std::size_t b = 0; b < bands; ++b) {
    shooter.coupling[b] +=
        area_factor * shooter.patches->frames()[link.shooter.root].reflectance[b];
  }
}

/// `before`: irradiance of every node (value, per band) before this gather.
void Gatherer::fill_coarse_row(std::span<const double> before, double closing) {
  const PatchForest& patches = receiver_.patches();
  const auto bands = static_cast<std::size_t>(patches.bands());
  const auto terms = static_cast<std::size_t>(patches.terms());
  CoarseRow& row = result_.coarse;
  row.change.assign(bands, 0.0);
  for (std::size_t k = 0; k < patches.polygons(); ++k) {
    const double area = patches.node(k).shape.area_m2;
    row.area_m2 += area;
    for (std::size_t b = 0; b < bands; ++b) {
      row.change[b] += area * (patches.irradiance(k)[b * terms] - before[k * bands + b]);
    }
  }
  for (auto& [cluster, shooter] : shooters_) {
    if (shooter.coupling.empty()) continue;
    for (double& c : shooter.coupling) c *= closing;
    row.entries.push_back({cluster, shooter.stale, shooter.coupling});
  }
}

/// First links: the whole receiving cluster from every whole visible cluster and every light.
void Gatherer::link_roots() {
  const PatchId root = receiver_.patches().root();
  LinkSet& links = receiver_.links();
  const std::vector<float> none(links.stride(), 0.0f);
  Link link;
  link.receiver = root;
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    link.shooter = {i, 1};
    links.add(link, none);
  }
  for (const auto& [cluster, shooter] : shooters_) {
    link.shooter_cluster = cluster;
    link.shooter = shooter.patches->root();
    links.add(link, none);
  }
}

bool Gatherer::can_split(const LinkSide& side) const {
  if (side.is_light()) return false;
  if (side.is_group()) return true;
  return side.id.path < (1u << config_.max_depth) && side.area_m2 > config_.min_area_m2 &&
         side.shape.deviations().y > 0.0;
}

/// Replaces the links whose error, at today's light, is above the tolerance.
void Gatherer::refine_links() {
  LinkSet& links = receiver_.links();
  LinkSet kept(links.stride());
  bool changed = false;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    double light = 0.0, variation = 0.0;
    if (link.evaluated || !link.is_light()) {
      const LinkSide shooter = shooter_side(link);
      light = shooter.light;
      variation = shooter.variation;
    } else {
      light = 1.0;
    }
    const bool fine = link.evaluated
                          ? link.finest || link.error * light + link.variation * variation <=
                                               config_.link_tolerance
                          : light <= 0.0 && variation <= 0.0;
    if (fine) {
      kept.add(link, links.transport(i));
      continue;
    }
    changed = true;
    pending_.push_back(link);
    while (!pending_.empty()) {
      const Link next = pending_.back();
      pending_.pop_back();
      refine(next, kept);
    }
  }
  if (changed) links = std::move(kept);
}

void Gatherer::refine(Link link, LinkSet& kept) {
  const LinkSide receiver = receiver_side(link);
  const LinkSide shooter = shooter_side(link);
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
  const double receiver_error = estimate.receiver_error * shooter.light;
  const double shooter_error = estimate.shooter_error * shooter.light + variation_error;
  const double error = receiver_error + shooter_error;
  if (error <= tolerance) {
    accept(link, shooter, estimate, false, kept);
    return;
  }
  // Split the side that dominates; where visibility alone is in doubt, the larger one.
  bool split_receiver = receiver_error > shooter_error ||
                        (receiver_error > 0.25 * shooter_error && !shooter_is_larger) ||
                        (variation_error < 0.5 * shooter_error && !shooter_is_larger);
  if (receiver.is_group()) split_receiver = !(shooter.is_group() && shooter_is_larger);
  if (shooter.is_group() && receiver.is_patch() && receiver_error < shooter_error)
    split_receiver = false;
  if (split_receiver ? !can_split(receiver) : !can_split(shooter)) split_receiver = !split_receiver;
  if (split_receiver ? !can_split(receiver) : !can_split(shooter)) {
    accept(link, shooter, estimate, true, kept);
    return;
  }
  split(receiver, shooter, split_receiver);
}

/// Puts the links between the halves of one side and the other side on the list.
void Gatherer::split(const LinkSide& receiver, const LinkSide& shooter, bool split_receiver) {
  ++result_.work.links_refined;
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
        result_.work.patches += 2;
      }
    }
  }
  for (const PatchId half : {halves[1], halves[0]}) {
    link.receiver = split_receiver ? half : receiver.id;
    link.shooter = split_receiver ? shooter.id : half;
    pending_.push_back(link);
  }
}

void Gatherer::accept(Link link, const LinkSide& shooter, const LinkEstimate& estimate, bool finest,
                      LinkSet& kept) {
  link.evaluated = true;
  link.finest = finest;
  link.error = static_cast<float>(estimate.receiver_error + estimate.shooter_error);
  link.variation = static_cast<float>(estimate.variation);
  if (shooter.is_patch()) {
    link.shooter_x = static_cast<float>(shooter.shape.centroid.x);
    link.shooter_y = static_cast<float>(shooter.shape.centroid.y);
  }
  kept.add(link, std::span<const float>(estimate.transport.data(), kept.stride()));
}

/// Adds a group's beam to its polygons: each gets the cosine's share of what a facing plane would.
void Gatherer::push_beam(const Link& link, std::span<const float> transport,
                         std::span<const double> light, std::vector<double>& gathered) const {
  const PatchForest& patches = receiver_.patches();
  const GroupNode& group = patches.groups()[link.receiver.group()];
  const Vec3 toward(transport[1], transport[2], transport[3]);
  const auto bands = static_cast<std::size_t>(patches.bands());
  const auto terms = static_cast<std::size_t>(patches.terms());
  for (std::uint32_t i = group.begin; i < group.end; ++i) {
    const std::uint32_t k = patches.order()[i];
    const double cosine = glm::dot(patches.frames()[k].n, toward);
    if (cosine <= 0.0 || patches.sealed(k)) continue;
    for (std::size_t band = 0; band < bands; ++band) {
      gathered[(k * bands + band) * terms] += transport[0] * cosine * light[band];
    }
  }
}

/// Gathers over every link, pushes and pulls, and measures what changed.
void Gatherer::collect() {
  PatchForest& patches = receiver_.patches();
  const auto bands = static_cast<std::size_t>(patches.bands());
  const auto terms = static_cast<std::size_t>(patches.terms());
  const std::size_t stride = bands * terms;
  std::vector<double> gathered(patches.size() * stride, 0.0);
  std::vector<double> light(stride, 0.0), means(bands, 0.0);
  const LinkSet& links = receiver_.links();
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    if (!link.evaluated) continue;
    const std::span<const float> transport = links.transport(i);
    double top = 0.0, variation = 0.0;
    std::fill(light.begin(), light.end(), 0.0);
    if (link.is_light()) {
      for (std::size_t b = 0; b < bands; ++b)
        light[b * terms] = lights_[link.shooter.root].intensity[b];
    } else {
      const PatchForest& from = forest(link.shooter_cluster);
      if (link.shooter.is_group()) {
        const std::span<const double> mean = from.group_radiosity(link.shooter.group());
        for (std::size_t b = 0; b < bands; ++b) light[b * terms] = mean[b];
        variation = from.group_spread(link.shooter.group());
      } else {
        const std::size_t node = from.find(link.shooter);
        const std::span<const double> b = from.radiosity(node);
        std::copy(b.begin(), b.end(), light.begin());
        if (terms == 3) {
          const PatchShape& shape = from.node(node).shape;
          const Vec2 shift = from.node(node).id == link.shooter
                                 ? Vec2(0.0)
                                 : Vec2(link.shooter_x, link.shooter_y) - shape.centroid;
          for (std::size_t t = 0; t < stride; t += 3) {
            light[t] += light[t + 1] * shift.x + light[t + 2] * shift.y;
          }
        }
        variation = from.deviation(node);
      }
    }
    for (std::size_t b = 0; b < bands; ++b) {
      means[b] = light[b * terms];
      top = std::max(top, std::abs(means[b]));
    }
    result_.link_error_power += link.error * top + link.variation * variation;
    ++result_.work.links_gathered;
    couple(link, transport);
    if (link.receiver.is_group()) {
      push_beam(link, transport, means, gathered);
      continue;
    }
    double* to = gathered.data() + patches.find(link.receiver) * stride;
    for (std::size_t b = 0; b < bands; ++b) {
      for (std::size_t r = 0; r < terms; ++r) {
        double sum = 0.0;
        for (std::size_t s = 0; s < terms; ++s)
          sum += transport[r * terms + s] * light[b * terms + s];
        to[b * terms + r] += sum;
      }
    }
  }

  const double closing = config_.close_rows ? close_rows(gathered) : 1.0;
  std::vector<double> before(patches.size() * bands), irradiance_before(patches.polygons() * bands);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    for (std::size_t b = 0; b < bands; ++b) {
      before[n * bands + b] = patches.radiosity(n)[b * terms];
      if (n < patches.polygons())
        irradiance_before[n * bands + b] = patches.irradiance(n)[b * terms];
    }
  }
  patches.push_pull(gathered);
  result_.work.push_pulls += patches.size();
  result_.absorbed_power.assign(bands, 0.0);
  std::vector<double> received(bands, 0.0), change(bands, 0.0);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const PatchNode& node = patches.node(n);
    if (!node.leaf()) continue;
    for (std::size_t b = 0; b < bands; ++b) {
      const double delta = std::abs(patches.radiosity(n)[b * terms] - before[n * bands + b]);
      const double power = node.shape.area_m2 * patches.irradiance(n)[b * terms];
      result_.max_change = std::max(result_.max_change, delta);
      change[b] += node.shape.area_m2 * delta;
      received[b] += power;
      result_.absorbed_power[b] += (1.0 - patches.frames()[node.id.root].reflectance[b]) * power;
    }
  }
  fill_coarse_row(irradiance_before, closing);
  receiver_.set_iteration(config_.iteration);
  result_.received_power = *std::max_element(received.begin(), received.end());
  result_.change_power = *std::max_element(change.begin(), change.end());
}

}  // namespace

GatherResult gather(ClusterState& receiver, std::span<const ClusterState* const> shooters,
                    std::span<const PointLight> lights, const Occluders& occluders,
                    const GatherConfig& config) {
  return Gatherer(receiver, shooters, lights, occluders, config).run();
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
