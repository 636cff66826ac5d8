#include "shares/share_scene.hpp"

#include "base/error.hpp"

namespace enfilade {
namespace {

/// Appends `times` copies of the first `bands` values.
void repeat(Spectrum& values, std::size_t bands, std::size_t times) {
  values.resize(bands * (1 + times));
  for (std::size_t i = bands; i < values.size(); ++i) values[i] = values[i - bands];
}

/// Appends zeros for each share but `own`, which gets the values again.
void set_apart(Spectrum& values, std::size_t bands, std::size_t shares, std::size_t own) {
  values.resize(bands * (1 + shares), 0.0);
  for (std::size_t b = 0; b < bands && own < shares; ++b)
    values[share_band(bands, own, b)] = values[b];
}

/// The group of each light and of each surface; the number of groups where it emits nothing.
struct GroupNumbers {
  std::vector<std::size_t> of_light, of_surface;

  GroupNumbers(const Scene& scene, std::span<const ShareGroup> groups)
      : of_light(scene.lights.size(), groups.size()),
        of_surface(scene.surfaces.size(), groups.size()) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
      for (const std::size_t light : groups[i].lights) of_light[light] = i;
      for (const SurfaceId surface : groups[i].surfaces) of_surface[surface.index()] = i;
    }
  }
};

}  // namespace

Scene share_scene(const Scene& scene, std::span<const ShareGroup> groups) {
  const auto bands = static_cast<std::size_t>(scene.bands);
  const GroupNumbers number(scene, groups);
  Scene wide = scene;
  wide.text.clear();
  wide.bands = static_cast<int>(bands * (1 + groups.size()));
  wide.lead_bands = scene.bands;
  for (std::size_t i = 0; i < wide.surfaces.size(); ++i) {
    repeat(wide.surfaces[i].reflectance, bands, groups.size());
    if (!wide.surfaces[i].transmittance.empty())
      repeat(wide.surfaces[i].transmittance, bands, groups.size());
    set_apart(wide.surfaces[i].exitance, bands, groups.size(), number.of_surface[i]);
  }
  for (std::size_t i = 0; i < wide.lights.size(); ++i)
    set_apart(wide.lights[i].intensity, bands, groups.size(), number.of_light[i]);
  return wide;
}

Scene dimmed_scene(const Scene& scene, std::span<const ShareGroup> groups,
                   std::span<const double> factors) {
  ENFILADE_CHECK(groups.size() == factors.size(), std::to_string(factors.size()));
  Scene dimmed = scene;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const std::size_t light : groups[i].lights)
      for (double& band : dimmed.lights[light].intensity) band *= factors[i];
    for (const SurfaceId surface : groups[i].surfaces)
      for (double& band : dimmed.surfaces[surface.index()].exitance) band *= factors[i];
  }
  return dimmed;
}

ClusterState same_patches(const ClusterState& state, const Cluster& cluster, const Scene& scene,
                          std::size_t aggregates) {
  ClusterState same(cluster, scene, state.basis(),
                    aggregates > 0 ? aggregates : state.aggregates().size());
  const PatchForest& from = state.patches();
  PatchForest& to = same.patches();
  ENFILADE_CHECK(from.polygons() == to.polygons(), std::to_string(cluster.id.value));
  for (std::size_t n = from.polygons(); n < from.size(); n += 2)  // the halves of a patch
    to.subdivide(static_cast<std::size_t>(from.node(n).parent));
  for (std::size_t n = 0; n < from.size(); ++n) {
    to.set_enclosed_share(n, from.enclosed_share(n), from.enclosed_share_settled(n));
    to.set_link_error(n, from.link_error(n));
  }
  for (std::size_t k = 0; k < from.polygons(); ++k) {
    if (from.unreachable(k)) to.mark_unreachable(k);
  }
  same.links() = state.links();
  same.shrink();
  return same;
}

}  // namespace enfilade
