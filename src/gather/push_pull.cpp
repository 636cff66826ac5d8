#include "gather/push_pull.hpp"

#include <algorithm>
#include <cmath>

#include "gather/extrapolate.hpp"

namespace enfilade {
namespace {

/// Sums the power that arrives at the leaves, and what becomes of it.
void add_balance(const ClusterState& receiver, IterationFigures& figures, CoarseRow& row) {
  const PatchForest& patches = receiver.patches();
  const auto bands = static_cast<std::size_t>(patches.bands()),
             terms = static_cast<std::size_t>(patches.terms());
  Spectrum absorbed(bands), escaping(bands);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    const PatchNode& node = patches.node(n);
    if (!node.leaf()) continue;
    const double area_m2 = node.shape.area_m2;
    const double enclosed_share = patches.enclosed_share(n);  // negative: not measured
    const double open_share = enclosed_share >= 0.0 ? 1.0 - enclosed_share : 0.0;
    for (std::size_t b = 0; b < bands; ++b) {
      const double power = area_m2 * patches.irradiance(n)[b * terms];
      const double reflectance = patches.frames()[node.id.root].reflectance[b];
      // What a pane passes is at most its transmittance at normal incidence.
      const BandValues& passes = patches.frames()[node.id.root].transmittance;
      absorbed[b] = (1.0 - reflectance - (passes.empty() ? 0.0 : passes[b])) * power;
      escaping[b] = open_share * reflectance * power;
      figures.arriving_power[b] += power;
      figures.absorbed_power[b] += absorbed[b];
      figures.escaping_power[b] += open_share * area_m2 * patches.radiosity(n)[b * terms];
    }
    receiver.aggregates().add(patches, node.id, absorbed, row.absorbed);
    receiver.aggregates().add(patches, node.id, escaping, row.escaping);
  }
}

/// Sums how the leaves' radiosity has changed; `before`: that of all nodes.
void add_change(const PatchForest& patches, std::span<const double> before,
                IterationFigures& figures) {
  const auto bands = static_cast<std::size_t>(patches.bands()),
             terms = static_cast<std::size_t>(patches.terms());
  Spectrum change(bands, 0.0);
  for (std::size_t n = 0; n < patches.size(); ++n) {
    if (!patches.node(n).leaf()) continue;
    for (std::size_t b = 0; b < bands; ++b) {
      const double delta =
          std::abs(patches.radiosity(n)[b * terms] - before[(n * bands + b) * terms]);
      figures.max_change = std::max(figures.max_change, delta);
      change[b] += patches.node(n).shape.area_m2 * delta;
    }
  }
  figures.change_power = *std::max_element(change.begin(), change.end());
}

/// Changes the shares' irradiance by `relaxation` times the change that was gathered (Richardson's
/// iteration). The lead bands stay as they are.
void relax_shares(PatchForest& patches, std::span<const double> gathered, double relaxation) {
  const auto bands = static_cast<std::size_t>(patches.bands()),
             terms = static_cast<std::size_t>(patches.terms());
  std::vector<double> pushed(gathered.begin(), gathered.end());
  patches.push(pushed, bands * terms, patches.bands());
  for (std::size_t n = 0; n < patches.size(); ++n) {
    if (!patches.node(n).leaf()) continue;
    const std::span<double> irradiance = patches.irradiance(n);
    for (std::size_t i = static_cast<std::size_t>(patches.lead_bands()) * terms; i < bands * terms;
         ++i) {
      irradiance[i] += relaxation * (pushed[n * bands * terms + i] - irradiance[i]);
    }
  }
  patches.pull();
}

}  // namespace

void push_pull(ClusterState& receiver, std::span<const double> gathered, const GatherConfig& config,
               IterationFigures& figures, CoarseRow& row) {
  PatchForest& patches = receiver.patches();
  const auto bands = static_cast<std::size_t>(patches.bands());
  const std::vector<double> before(patches.radiosities().begin(), patches.radiosities().end());
  row.before = arriving_power(receiver);
  if (patches.lead_bands() < patches.bands()) {
    relax_shares(patches, gathered, config.relaxation);
    // Each link has been gathered over once for each light.
    figures.work.links_gathered *=
        static_cast<std::uint64_t>(patches.bands() / patches.lead_bands());
  } else {
    const std::vector<double> earlier = patches.take_kept_light();
    if (config.extrapolation >= 1.0) patches.keep_light();
    patches.push_pull(gathered);
    if (config.extrapolation > 1.0) extrapolate(receiver, earlier, config.extrapolation);
  }
  figures.work.push_pulls += patches.size();
  add_change(patches, before, figures);
  row.after = arriving_power(receiver);
  row.aggregates = receiver.aggregates().size();
  row.absorbed.assign(row.aggregates * bands, 0.0);
  row.escaping.assign(row.aggregates * bands, 0.0);
  for (Spectrum* power :
       {&figures.arriving_power, &figures.absorbed_power, &figures.escaping_power}) {
    power->assign(bands, 0.0);
  }
  add_balance(receiver, figures, row);
  figures.received_power =
      *std::max_element(figures.arriving_power.begin(), figures.arriving_power.end());
}

}  // namespace enfilade
