#include "occluders/panes.hpp"

#include <algorithm>
#include <cmath>

#include "scene/pane_law.hpp"

namespace enfilade {
namespace {

constexpr std::size_t all_of_them = 1u << 30;

std::vector<Polygon> panes_of(std::span<const Cluster> clusters) {
  std::vector<Polygon> polygons;
  for (const Cluster& cluster : clusters) {
    for (const ClusterPolygon& p : cluster.polygons) {
      if (p.pane && !p.transmittance.empty()) polygons.push_back(p.polygon);
    }
  }
  return polygons;
}

}  // namespace

Panes::Panes(std::span<const Cluster> clusters) : shafts_(panes_of(clusters)) {
  std::uint32_t number = 0;
  for (const Cluster& cluster : clusters) {
    for (const ClusterPolygon& p : cluster.polygons) {
      const std::uint32_t polygon = number++;
      if (!p.pane) continue;
      if (p.transmittance.empty()) {
        backs_.push_back(polygon);
        continue;
      }
      Pane pane{*std::ranges::max_element(p.transmittance), {}};
      const bool grey =
          std::ranges::all_of(p.transmittance, [&](double t) { return t == pane.most; });
      for (std::size_t b = 0; b < p.transmittance.size() && !grey; ++b)
        pane.tint.push_back(p.transmittance[b] / pane.most);
      polygons_.push_back(polygon);
      panes_.push_back(std::move(pane));
    }
  }
}

std::size_t Panes::index_of(std::uint32_t polygon) const {
  const auto at = std::ranges::lower_bound(polygons_, polygon);
  return at != polygons_.end() && *at == polygon ? static_cast<std::size_t>(at - polygons_.begin())
                                                 : panes_.size();
}

bool Panes::contains(std::uint32_t polygon) const {
  return any() &&
         (index_of(polygon) < panes_.size() || std::ranges::binary_search(backs_, polygon));
}

void Panes::dim(Passage& passage, std::uint32_t polygon, double cosine) const {
  const std::size_t i = index_of(polygon);
  if (i == panes_.size()) return;
  const Pane& pane = panes_[i];
  passage.share *= pane.most * pane_share(cosine);
  if (pane.tint.empty()) return;
  if (passage.tint.empty()) passage.tint.assign(pane.tint.size(), 1.0);
  for (std::size_t b = 0; b < pane.tint.size(); ++b) passage.tint[b] *= pane.tint[b];
}

void Panes::find_between(const Polygon& a, const Polygon& b, double tolerance_m,
                         std::uint32_t skip_a, std::uint32_t skip_b,
                         std::vector<std::uint32_t>& found) const {
  if (panes_.empty()) return;
  const auto own_number = [this](std::uint32_t polygon) {
    const std::size_t i = index_of(polygon);
    return i < panes_.size() ? static_cast<std::uint32_t>(i) : RayScene::no_polygon;
  };
  const std::size_t before = found.size();
  shafts_.find(shaft_between(a, b, tolerance_m), tolerance_m, own_number(skip_a),
               own_number(skip_b), all_of_them, found);
  for (std::size_t i = before; i < found.size(); ++i) found[i] = polygons_[found[i]];
}

}  // namespace enfilade
