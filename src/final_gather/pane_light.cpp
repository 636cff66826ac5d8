#include "final_gather/pane_light.hpp"

namespace enfilade {

bool add_pane_light(const PathLeg& leg, std::span<const ClusterState> clusters,
                    const Occluders& occluders, const EmitterSampler& emitters,
                    const EmitterSampler::ControlVariate* control, std::vector<double>& carried,
                    Spectrum& e) {
  const std::vector<PaneMet> met = occluders.panes_along(
      leg.from, leg.direction, leg.hit.any() ? leg.hit.distance_m : far_away_m, leg.own,
      RayStart::in_air);
  Spectrum radiosity(e.size());
  for (const PaneMet& pane : met) {
    const auto* controlled = control != nullptr ? control->find(pane.polygon) : nullptr;
    if (!pane.front || (emitters.contains(pane.polygon) && controlled == nullptr)) continue;
    const PolygonRef ref = occluders.local(pane.polygon);
    const PatchForest& patches = clusters[ref.cluster.index()].patches();
    const Vec3 at = leg.from + pane.distance_m * leg.direction;
    const VisibleNode* node =
        controlled != nullptr ? node_around(controlled->nodes, patches, ref.polygon, at) : nullptr;
    patches.evaluate(true, ref.polygon, at, radiosity);
    for (std::size_t b = 0; b < e.size(); ++b) {
      const double less =
          node != nullptr ? node->radiosity(patches, b, at) - control->ambient[b] : 0.0;
      e[b] += carried[b] * pane.before.band(b) * (radiosity[b] - less);
    }
  }
  if (met.empty()) return false;
  for (std::size_t b = 0; b < e.size(); ++b) carried[b] *= met.back().behind.band(b);
  return true;
}

}  // namespace enfilade
