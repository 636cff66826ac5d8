#include "gather/row_closure.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace enfilade {
namespace {

/// Uncertainty of a group link, as a share of its factor: one direction stands for the light of all
/// polygons of the shooting group.
constexpr double group_uncertainty = 0.3;
/// A row's summed link errors count as two standard deviations.
constexpr double deviation_of_uncertainty = 0.5;
/// The transports of reflected light of a row may sum to more than its enclosed share, since what a
/// leaf sees of a far node may be brighter than its mean; no further than to this over the leaf's
/// reflectance, or light would grow from iteration to iteration.
constexpr double most_gain = 0.95;

}  // namespace

RowClosure::Columns::Columns(std::size_t terms, std::size_t bands)
    : factor(terms),
      uncertainty(factor + 1),
      doubtful(uncertainty + 1),
      far_factor(doubtful + 1),
      far_gain(far_factor + 1),
      uncertain_light(far_gain + 1),
      doubtful_light(uncertain_light + bands),
      light(doubtful_light + bands),
      far_light(light + bands),
      uncertain_arrival(far_light + bands),
      width(uncertain_arrival + bands) {}

RowClosure::RowClosure(ClusterState& receiver, const BuildingLight* far, const OpennessRays& rays)
    : receiver_(receiver),
      far_(far),
      least_(rays),
      bands_(static_cast<std::size_t>(receiver.bands())),
      lead_bands_(static_cast<std::size_t>(receiver.patches().lead_bands())),
      terms_(static_cast<std::size_t>(receiver.patches().terms())),
      at_(terms_, bands_) {}

void RowClosure::add_shooter(const ClusterState& shooter) {
  const PatchForest& patches = shooter.patches();
  ENFILADE_CHECK(lit_from_.empty() || lit_from_.back().first < shooter.id(),
                 std::to_string(shooter.id().value));
  lit_from_.emplace_back(shooter.id(), lit_.size());
  lit_.insert(lit_.end(), patches.lit().begin(), patches.lit().end());
  lit_in_view_ += patches.lit_polygons();
}

void RowClosure::add(std::size_t node, const Addition& addition, std::span<const double> light,
                     std::span<const double> reflected) {
  rows_.resize(std::max(rows_.size(), receiver_.patches().size() * at_.width), 0.0);
  double* to = row(node);
  const double doubtful = std::min(addition.uncertainty, addition.factor);
  to[0] += addition.factor;
  to[at_.factor] += addition.factor;
  to[at_.uncertainty] += addition.uncertainty;
  to[at_.doubtful] += doubtful;
  if (!reflected.empty()) {
    to[at_.far_factor] += addition.factor;
    to[at_.far_gain] += addition.far_gain;
    for (std::size_t b = 0; b < bands_; ++b)
      to[at_.far_light + b] += addition.far_gain * reflected[b];
  }
  double top = 0.0;  // by the links' errors, light is negative in places
  for (const double l : light.first(lead_bands_)) top = std::max(top, std::abs(l));
  const double varies = top > 0.0 ? addition.uncertainty_of_variation / top : 0.0;
  for (std::size_t b = 0; b < bands_; ++b) {
    to[at_.uncertain_light + b] += addition.uncertainty * light[b];
    to[at_.doubtful_light + b] += doubtful * light[b];
    to[at_.light + b] += addition.factor * light[b];
    to[at_.uncertain_arrival + b] += (addition.uncertainty + varies) * light[b];
  }
}

void RowClosure::add(const Link& link, std::span<const float> transport,
                     std::span<const double> light, std::span<const double> reflected,
                     double variation) {
  if (link.is_light()) return;
  const PatchForest& patches = receiver_.patches();
  const float factor = link.is_far() ? transport[FarTerms::of(link).factor] : transport[0];
  if (link.receiver.is_group()) {
    for_each_facing(patches, link, transport, [&](std::uint32_t k, double cosine) {
      add(k, {factor * cosine, factor * cosine * group_uncertainty, 0.0, transport[0] * cosine},
          light, reflected);
    });
    return;
  }
  // A link without any transport has no uncertainty here: the missing light comes from visible
  // shooters.
  const std::size_t node = patches.find(link.receiver);
  const double per_m2 = factor > 0.0f ? 1.0 / patches.node(node).shape.area_m2 : 0.0;
  double uncertainty = per_m2 * link.error;
  // A far link's error is one of its power: where its node sends next to nothing this way, it is
  // many times the light there, but what is seen of the node is no more uncertain than its factor.
  if (link.is_far()) uncertainty = std::min(uncertainty, double{factor});
  add(node, {factor, uncertainty, per_m2 * link.variation * variation, transport[0]}, light,
      reflected);
  if (terms_ == 3 && !link.is_far()) {
    row(node)[1] += transport[3];
    row(node)[2] += transport[6];
  }
}

/// Of a cluster that is no shooter, only the far field's light is known: all of it counts as lit,
/// or none.
bool RowClosure::lit(const PolygonRef& polygon) const {
  const auto shooter = std::lower_bound(lit_from_.begin(), lit_from_.end(),
                                        std::pair(polygon.cluster, std::size_t{0}));
  if (shooter != lit_from_.end() && shooter->first == polygon.cluster) {
    return lit_[shooter->second + polygon.polygon] != 0;
  }
  return far_ != nullptr && !far_->is_dark(far_->tree().leaf_of(polygon.cluster));
}

std::vector<char> RowClosure::find_openings(int rings, const Occluders& occluders,
                                            WorkCount& work) {
  PatchForest& patches = receiver_.patches();
  const auto is_lit = [this](const PolygonRef& polygon) { return lit(polygon); };
  const bool frozen = lead_bands_ < bands_;  // the light that shares are of has measured them
  if (!frozen) {
    patches.forget_enclosed_shares_below(
        far_ == nullptr ? lit_in_view_
                        : static_cast<std::uint32_t>(far_->lit_polygons(BuildingTree::root)));
  }
  std::vector<char> open(patches.polygons(), 0);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const PatchNode& node = patches.node(n);
    if (!node.leaf()) continue;
    if (patches.unreachable(node.id.root)) patches.set_enclosed_share(n, 0.0f, true);
    if (patches.enclosed_share(n) < 0.0f && !frozen) {
      const EnclosedShare found = enclosed_share(receiver_, node, rings, occluders, is_lit, work);
      patches.set_enclosed_share(n, static_cast<float>(found.share), found.pending == 0.0);
    }
    if (patches.enclosed_share(n) < 1.0f) open[node.id.root] = 1;
  }
  return open;
}

void RowClosure::correct_flux(std::size_t leaf, const Spectrum& flux_correction,
                              std::vector<double>& gathered) const {
  for (std::size_t b = 0; b < flux_correction.size(); ++b) {
    gathered[(leaf * bands_ + b) * terms_] += flux_correction[b] * uncertain_light(leaf, b);
  }
}

/// The rays know the sum of an open row to within their own variance, the links to within their
/// uncertainty: the deficit is weighted by the one against the other (as the gain of a Kalman
/// filter is). A row without an opening sums to 1 exactly.
RowClosure::Deficit RowClosure::deficit(std::size_t leaf, bool open, double rays) const {
  const double target = receiver_.patches().enclosed_share(leaf);
  const double deviation = deviation_of_uncertainty * uncertainty(leaf);
  const double variance = (target * (1.0 - target) + 1.0 / rays) / rays;
  Deficit deficit;
  if (open) deficit.gain = deviation * deviation / (deviation * deviation + variance);
  deficit.missing = deficit.gain * (target - row(leaf)[0]);
  deficit.beyond = std::max(0.0, deficit.missing - uncertainty(leaf));
  return deficit;
}

/// The radiosity B = rho (E + F B) + exitance of a leaf that sees its like in the share F =
/// `beyond` of its hemisphere and receives `arrived` (E) from elsewhere.
double RowClosure::own_radiosity(std::size_t leaf, std::size_t band, double beyond,
                                 double arrived) const {
  const PolygonFrame& frame = receiver_.patches().frames()[receiver_.patches().node(leaf).id.root];
  const double rho = frame.reflectance[band];
  return (rho * arrived + frame.exitance[band]) / (1.0 - rho * std::min(beyond, 1.0));
}

/// Within the links' uncertainty, the missing share of the hemisphere shows the mean light of the
/// links, weighted by their uncertainty. The excess beyond it is light that no link represents, as
/// between panels that nearly touch; it is given the lower of the links' mean radiosity and the
/// leaf's own: to its shares, as to the lead band that they are of.
void RowClosure::add_missing(std::size_t leaf, const Deficit& deficit,
                             std::span<const double> arrived, std::vector<double>& gathered) {
  const double* sums = row(leaf);
  lead_beyond_.resize(lead_bands_);
  for (std::size_t b = 0; b < bands_; ++b) {
    const std::size_t at = (leaf * bands_ + b) * terms_;
    double* to = gathered.data() + at;
    const double light = sums[at_.uncertain_light + b] / uncertainty(leaf);
    const double within = deficit.within() * light;
    to[0] += within;
    if (deficit.beyond > 0.0) {
      Beyond& lead = lead_beyond_[b % lead_bands_];
      if (b < lead_bands_) lead.dark = arrived[at] + within < 0.0;
      const double own =
          own_radiosity(leaf, b, deficit.beyond, lead.dark ? 0.0 : arrived[at] + within);
      if (b < lead_bands_) lead.own = own < light;
      to[0] += deficit.beyond * (lead.own ? own : light);
    }
    if (terms_ == 3) {  // the target is the same all over the leaf
      to[1] -= deficit.gain * sums[1] * light;
      to[2] -= deficit.gain * sums[2] * light;
    }
  }
}

/// Takes the excess from the links in proportion to their doubtful factors, what remains from all:
/// from none more than it brought, so that the row's coefficients stay positive and sum to the
/// target.
void RowClosure::take_excess(std::size_t leaf, const Deficit& deficit,
                             std::vector<double>& gathered) const {
  const double* sums = row(leaf);
  const double excess = std::min(-deficit.missing, sums[at_.factor]);
  const double doubtful = sums[at_.doubtful];
  const double taken = std::min(excess, doubtful);
  const double share = doubtful > 0.0 ? taken / doubtful : 0.0;
  const double certain = sums[at_.factor] - taken;
  for (std::size_t b = 0; b < bands_; ++b) {
    double* to = gathered.data() + (leaf * bands_ + b) * terms_;
    const double from_doubtful = share * sums[at_.doubtful_light + b];
    to[0] -= from_doubtful;
    if (excess > taken && certain > 0.0)
      to[0] -= (excess - taken) * (sums[at_.light + b] - from_doubtful) / certain;
    if (terms_ == 3 && sums[at_.factor] > 0.0) {
      const double light = sums[at_.light + b] / sums[at_.factor];
      to[1] -= deficit.gain * sums[1] * light;
      to[2] -= deficit.gain * sums[2] * light;
    }
  }
}

/// Takes from the reflected light of far shooters what exceeds the limit. `added` (below zero:
/// taken): to the row by its closure.
void RowClosure::limit_gain(std::size_t leaf, double added, std::vector<double>& gathered) const {
  const PatchForest& patches = receiver_.patches();
  const BandValues& reflectance = patches.frames()[patches.node(leaf).id.root].reflectance;
  const double worst = *std::max_element(reflectance.begin(), reflectance.end());
  const double* sums = row(leaf);
  const double gain = sums[0] + added + sums[at_.far_gain] - sums[at_.far_factor];
  const double limit = std::max(1.0, worst > 0.0 ? most_gain / worst : gain);
  if (gain <= limit || sums[at_.far_gain] <= 0.0) return;
  const double share = std::min(1.0, (gain - limit) / sums[at_.far_gain]);
  for (std::size_t b = 0; b < bands_; ++b)
    gathered[(leaf * bands_ + b) * terms_] -= share * sums[at_.far_light + b];
}

RowClosureSums RowClosure::close(const Occluders& occluders, const Spectrum& flux_correction,
                                 WorkCount& work, std::vector<double>& gathered) {
  const PatchForest& patches = receiver_.patches();
  rows_.resize(patches.size() * at_.width, 0.0);
  patches.push(rows_, at_.width, 1);
  const std::size_t leaves = patches.polygons() + (patches.size() - patches.polygons()) / 2;
  const int rings = std::max(
      least_.rings,
      static_cast<int>(std::sqrt(0.25 * least_.per_cluster / static_cast<double>(leaves))));
  const std::vector<char> open = find_openings(rings, occluders, work);
  std::vector<double> arrived(gathered);  // from links at the leaf and above it
  patches.push(arrived, bands_ * terms_, patches.bands());
  RowClosureSums sums{Spectrum(bands_, 0.0), {}};
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const PatchNode& node = patches.node(n);
    if (!node.leaf()) continue;
    const double area_m2 = node.shape.area_m2, target = patches.enclosed_share(n);
    for (std::size_t b = 0; b < bands_; ++b) {
      sums.uncertain_power[b] += area_m2 * uncertain_light(n, b);
    }
    correct_flux(n, flux_correction, gathered);
    if (target <= 0.0) continue;
    sums.rows.add(area_m2, row(n)[0], target);
    if (uncertainty(n) <= 0.0) continue;
    const Deficit missing = deficit(n, open[node.id.root] != 0, 4.0 * rings * rings);
    if (missing.missing >= 0.0) {
      add_missing(n, missing, arrived, gathered);
    } else {
      take_excess(n, missing, gathered);
    }
    limit_gain(n, missing.missing, gathered);
  }
  return sums;
}

}  // namespace enfilade
