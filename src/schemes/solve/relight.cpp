#include "schemes/solve/relight.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "run/solution.hpp"
#include "scene/equal_bands.hpp"
#include "shares/share_scene.hpp"

namespace enfilade {
namespace {

/// Lengths and shares that differ by less are the same, whatever their rounding in files.
constexpr double rounding = 1e-9;

bool alike(double a, double b) { return std::abs(a - b) <= rounding * std::max(1.0, std::abs(a)); }
bool alike(const Vec3& a, const Vec3& b) {
  return alike(a.x, b.x) && alike(a.y, b.y) && alike(a.z, b.z);
}

/// Does the intensity depend on the direction in the same way, whatever its mean?
bool alike(const IntensityDistribution* a, const IntensityDistribution* b) {
  if (a == b || a == nullptr || b == nullptr) return a == b;
  const IntensityTable &s = a->table(), &t = b->table();
  if (s.type != t.type || s.planes != t.planes || s.angles != t.angles) return false;
  for (std::size_t i = 0; i < s.candela.size(); ++i) {
    if (!alike(s.candela[i] / a->mean(), t.candela[i] / b->mean())) return false;
  }
  return true;
}

/// The same sky, whatever its luminance.
bool alike(const Sky* a, const Sky* b) {
  if (a == nullptr || b == nullptr) return a == b;
  const SkyShape &s = a->shape, &t = b->shape;
  return s.overcast == t.overcast && alike(s.a, t.a) && alike(s.b, t.b) && alike(s.c, t.c) &&
         alike(s.d, t.d) && alike(s.e, t.e) && alike(a->zenith, b->zenith) &&
         (!s.needs_sun() || alike(a->sun, b->sun));
}

/// The same cone of light, or none.
bool alike(const std::optional<SpotCone>& a, const std::optional<SpotCone>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return alike(a->inner, b->inner) && alike(a->outer, b->outer);
}

bool alike(const LightSource& a, const LightSource& b) {
  const auto same_opening = [&] {
    return std::ranges::equal(a.opening, b.opening, [](const Polygon& p, const Polygon& q) {
      return std::ranges::equal(p, q, [](const Vec3& x, const Vec3& y) { return alike(x, y); });
    });
  };
  return alike(a.p, b.p) && alike(a.frame.aim, b.frame.aim) && alike(a.frame.up, b.frame.up) &&
         alike(a.distribution.get(), b.distribution.get()) && alike(a.cone, b.cone) &&
         alike(a.sky.get(), b.sky.get()) && alike(a.far_m, b.far_m) && same_opening();
}

bool shines(const LightSource& light) {
  return std::ranges::any_of(light.intensity, [](double band) { return band > 0.0; });
}

}  // namespace

std::vector<std::uint32_t> lights_with_links(const Scene& now, const Scene& before) {
  std::vector<std::uint32_t> old_light;
  std::vector<char> taken(before.lights.size(), 0);
  for (std::size_t i = 0; i < now.lights.size(); ++i) {
    old_light.push_back(Relight::none);
    for (std::size_t k = 0; k < before.lights.size(); ++k) {
      const std::size_t j = (i + k) % before.lights.size();  // most often the i-th
      if (taken[j] != 0 || !shines(before.lights[j]) || !alike(now.lights[i], before.lights[j]))
        continue;
      taken[j] = 1;
      old_light.back() = static_cast<std::uint32_t>(j);
      break;
    }
  }
  return old_light;
}

std::vector<std::uint32_t> bands_before(const Scene& now, const Scene& before) {
  if (bands_of_file(now) != bands_of_file(before)) {
    throw InputError(now.file, "bands",
                     "has " + std::to_string(bands_of_file(now)) + ", the run has " +
                         std::to_string(bands_of_file(before)),
                     "give all spectra as many values, or solve without --relight");
  }
  std::vector<std::uint32_t> old_band(static_cast<std::size_t>(now.bands), 0);
  for (std::size_t b = 0; b < bands_of_file(now); ++b) {
    const std::size_t to = now.band_of.empty() ? b : now.band_of[b];
    old_band[to] = static_cast<std::uint32_t>(before.band_of.empty() ? b : before.band_of[b]);
  }
  return old_band;
}

RelitClusters::RelitClusters(const Relight& relight, const Prepared& prepared)
    : relight_(relight), prepared_(prepared) {
  const RunLayout layout(relight.from);
  const std::optional<Manifest> manifest = read_manifest(layout);
  if (!manifest || manifest->clusters != prepared.clusters.size()) {
    throw RunError(layout.manifest() + ": is of other clusters; solve without --relight");
  }
  solution_.emplace(layout, *manifest);
}

LinkSet RelitClusters::links_of(const ClusterState& old) const {
  const LinkSet& links = old.links();
  LinkSet kept(links.stride());
  const auto keep = [&](const Link& link, std::size_t k) {
    std::vector<double> tint;
    for (std::size_t b = 0; b < relight_.old_band.size() && !links.tint(k).empty(); ++b)
      tint.push_back(links.tint(k)[relight_.old_band[b]]);
    kept.add(link, links.transport(k), tint);
  };
  for (std::uint32_t i = 0; i < relight_.old_light.size(); ++i) {
    if (relight_.old_light[i] == Relight::none) {
      Link link;
      link.receiver = old.patches().root();
      link.shooter = {i, 1};
      kept.add(link, std::vector<float>(links.stride(), 0.0f));
      continue;
    }
    for (std::size_t k = 0; k < links.size() && links[k].is_light(); ++k) {
      if (links[k].shooter.root != relight_.old_light[i]) continue;
      Link link = links[k];
      link.shooter.root = i;
      link.finest = link.evaluated;
      keep(link, k);
    }
  }
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (links[k].is_light()) continue;
    Link link = links[k];
    if (!link.is_far()) link.finest = link.evaluated;
    keep(link, k);
  }
  return kept;
}

ClusterState RelitClusters::make(ClusterState initial) const {
  const ClusterId id = initial.id();
  const ClusterState old = solution_->read(id, true);
  for (std::size_t k = 0; k < old.patches().polygons(); ++k) {
    if (old.patches().unreachable(k) && !initial.patches().unreachable(k)) return initial;
  }
  ClusterState state = same_patches(old, prepared_.clusters[id.index()], prepared_.scene,
                                    initial.aggregates().size());
  PatchForest& patches = state.patches();
  const auto terms = static_cast<std::size_t>(patches.terms());
  for (std::size_t n = 0; n < patches.size(); ++n) {
    for (std::size_t b = 0; b < relight_.old_band.size(); ++b) {
      std::copy_n(old.patches().irradiance(n).begin() +
                      static_cast<std::ptrdiff_t>(relight_.old_band[b] * terms),
                  terms, patches.irradiance(n).begin() + static_cast<std::ptrdiff_t>(b * terms));
    }
  }
  patches.pull();
  state.links() = links_of(old);
  state.set_iteration(gathered_before);
  return state;
}

}  // namespace enfilade
