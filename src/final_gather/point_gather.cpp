#include "final_gather/point_gather.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "final_gather/emitter_picker.hpp"
#include "final_gather/emitter_sampler.hpp"
#include "final_gather/mean_light.hpp"
#include "final_gather/pane_light.hpp"
#include "final_gather/point_place.hpp"
#include "final_gather/ray_ends.hpp"
#include "geometry/sampling.hpp"
#include "occluders/light_at.hpp"

namespace enfilade {
namespace {

/// Nodes of controlled polygons are as fine as this share of a point's light asks for: with the
/// noise, within these bounds.
double least_share(const PointGatherConfig& config) {
  constexpr double least = 3e-4, most = 5e-3;
  const double noise = config.least_noise();
  return noise > 0.0 ? std::clamp(noise, least, most) : most;
}

constexpr double faint = 0.05;  ///< Paths that carry less of what they began with end by chance.
constexpr int most_bounces = 64;
constexpr int most_survey_rays = 576;  ///< show what a point sees, before others estimate its light
constexpr int most_ray_sets = 16;      ///< for one point, each of rays_in_set() rays
constexpr double unseen_noise = 2e-5;  ///< Less of the mean irradiance does not matter.
/// Of the mean irradiance: in darker places noise may be a larger share of the light.
constexpr double dark_share = 0.02;
/// Noise of so much of the error of the reflected light adds next to nothing to it; it may be so
/// many times what is asked for without that error.
constexpr double share_of_error = 0.25, most_easing = 2.0;
/// Links are refined by the power at stake, so that the light of dark rooms is less accurate than
/// its own amount tells: its error is relative to this share of the mean irradiance as well.
constexpr double share_everywhere = 0.1;
/// Of the ambient light: what adding and subtracting the control variate leaves.
constexpr double rounding = 1e-12;

/// How the paths from one point go on.
struct Paths {
  std::vector<double> weights;  ///< EmitterPicker::weights()
  double far_sides;             ///< far_sides()
};

}  // namespace

struct PointGather::Impl {
  std::span<const ClusterState> clusters;
  std::span<const LightSource> lights;
  const Occluders* occluders;
  PointGatherConfig config;
  EmitterSampler emitters;
  EmitterPicker picker;
  std::size_t bands, lead_bands;
  Spectrum mean_irradiance;
  double mean_link_error;

  Impl(std::span<const ClusterState> of, std::span<const LightSource> by, const Occluders& between,
       const PointGatherConfig& how);
  void add_lights(const LitPlace& place, Spectrum& e, Spectrum& variance) const;
  RayEnds add_hemisphere(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                         const EmitterSampler::ControlVariate& control, const Spectrum& emitted,
                         Spectrum& variance, PointIrradiance& light) const;
  double most_noise(std::size_t band, double light, double reflected) const;
  double reflected_error(std::size_t band, double reflected) const;
  Spectrum add_rays(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                    const EmitterSampler::ControlVariate& control, const Paths& paths, Spectrum& e,
                    RayEnds& ends) const;
  void add_path(Vec3 from, Vec3 direction, std::uint32_t own, double share, const Paths& paths,
                const EmitterSampler::ControlVariate& control, Random& random, Spectrum& e,
                RayEnds& ends) const;
};

/// Adds the direct light, and to `variance` the square of its error.
void PointGather::Impl::add_lights(const LitPlace& place, Spectrum& e, Spectrum& variance) const {
  for (const LightSource& light : lights) {
    const LightAtPoint found = light_at(light, place, *occluders);
    for (std::size_t band = 0; band < bands; ++band) {
      e[band] += light.intensity[band] * found.band(band);
      const double error = light.intensity[band] * found.error;
      variance[band] += error * error;
    }
  }
}

/// Adds share * (the radiosity that a ray finds less the control variate in its direction). Where a
/// ray ends on a patch that is large for its distance (a gap below a cupboard, a corner), the
/// patch's mean is not the radiosity at the ray's end: the path goes on from the end with one
/// random ray, and with direct light there, and so on.
void PointGather::Impl::add_path(Vec3 from, Vec3 direction, std::uint32_t own, double share,
                                 const Paths& paths, const EmitterSampler::ControlVariate& control,
                                 Random& random, Spectrum& e, RayEnds& end) const {
  std::vector<double> carried(bands, share), radiosity(bands);
  for (int bounces = 0; bounces < most_bounces; ++bounces) {
    const RayHit hit = occluders->rays().closest(from, direction, own, 1e30, RayStart::in_air);
    if (bounces == 0 && hit.any()) ++(hit.front ? end.front : end.back);
    const bool ends = !hit.any() || !hit.front;
    const auto* controlled = bounces == 0 && !ends ? control.find(hit.polygon) : nullptr;
    // Behind panes the control variate is the ambient light and, of each controlled polygon, what
    // it sends more than that, dimmed.
    const bool dimmed = occluders->panes().any() &&
                        add_pane_light({from, direction, hit, own}, clusters, *occluders, emitters,
                                       bounces == 0 ? &control : nullptr, carried, e);
    const Vec3 at = from + hit.distance_m * direction;
    const VisibleNode* node = nullptr;
    if (controlled != nullptr) {
      const PolygonRef ref = occluders->local(hit.polygon);
      const PatchForest& patches = clusters[ref.cluster.index()].patches();
      node = node_around(controlled->nodes, patches, ref.polygon, at);
      for (std::size_t b = 0; b < bands && node != nullptr; ++b) {
        const double rest = dimmed ? control.ambient[b] : 0.0;
        e[b] -= carried[b] * (node->radiosity(patches, b, at) - rest);
      }
    }
    for (std::size_t b = 0; b < bands && bounces == 0 && (node == nullptr || dimmed); ++b)
      e[b] -= share * control.ambient[b];
    if (ends || (emitters.contains(hit.polygon) && controlled == nullptr)) return;
    const PolygonRef ref = occluders->local(hit.polygon);
    const PatchForest& patches = clusters[ref.cluster.index()].patches();
    const std::size_t leaf = patches.leaf_at(ref.polygon, at);
    const double m2 = patches.node(leaf).shape.area_m2;
    if (hit.distance_m > paths.far_sides * std::sqrt(m2) || emitters.contains(hit.polygon)) {
      patches.evaluate(true, ref.polygon, at, radiosity);
      for (std::size_t b = 0; b < bands; ++b) e[b] += carried[b] * radiosity[b];
      end.read(patches, leaf, carried, radiosity);
      return;
    }
    const PolygonFrame& frame = patches.frames()[ref.polygon];
    double most = 0.0;
    for (std::size_t b = 0; b < bands; ++b) {
      e[b] += carried[b] * frame.exitance[b];
      carried[b] *= frame.reflectance[b];
      most = std::max(most, carried[b]);
    }
    // Russian roulette (Arvo and Kirk 1990).
    const double survival = std::min(1.0, most / (faint * share));
    if (random.uniform() >= survival) return;
    for (double& c : carried) c /= survival;
    own = hit.polygon;
    from = at + 2.0 * occluders->rays().epsilon_m() * frame.n;
    picker.add_picked({from, frame.n, own, RayStart::in_air}, paths.weights, random, carried, e);
    const double r2 = random.uniform(), turn = random.uniform();
    direction = cosine_direction(frame.n, r2, turn);
  }
}

/// Adds the mean of a set of cosine-weighted rays, one in each stratum of the disc below the
/// hemisphere (Nusselt). Returns its variance per band, from the differences between neighbouring
/// strata.
Spectrum PointGather::Impl::add_rays(const Vec3& p, const Vec3& n, std::uint32_t own,
                                     Random& random, const EmitterSampler::ControlVariate& control,
                                     const Paths& paths, Spectrum& e, RayEnds& ends) const {
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(config.rays_in_set()))));
  Spectrum variance(bands, 0.0), one(bands), before(bands);
  const int pairs = side * side / 2;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double r2 = (i + random.uniform()) / side, turn = (j + random.uniform()) / side;
      std::fill(one.begin(), one.end(), 0.0);
      add_path(p, cosine_direction(n, r2, turn), own, 1.0 / (side * side), paths, control, random,
               one, ends);
      for (std::size_t b = 0; b < bands; ++b) {
        e[b] += one[b];
        if ((i * side + j) % 2 == 1) variance[b] += (one[b] - before[b]) * (one[b] - before[b]);
      }
      before = one;
    }
  }
  // An odd ray is assumed to be as noisy as the pairs are. A single ray says nothing about noise.
  for (double& v : variance) {
    v = pairs > 0 ? v * side * side / (2.0 * pairs) : std::numeric_limits<double>::infinity();
  }
  return variance;
}

/// Returns the noise that is allowed at a point with this much light in a band, of which some is
/// reflected.
double PointGather::Impl::most_noise(std::size_t band, double light, double reflected) const {
  const double mean = mean_irradiance[band];
  if (config.noise) return std::max(*config.noise * light, unseen_noise * mean);
  const double least = config.least_noise() * (light + dark_share * mean);
  return std::clamp(share_of_error * reflected_error(band, reflected), least, most_easing * least);
}

/// One standard deviation of the reflected light of a band, by the patches.
double PointGather::Impl::reflected_error(std::size_t band, double reflected) const {
  return config.reflected_error *
         (std::max(0.0, reflected) + share_everywhere * mean_irradiance[band]);
}

/// Adds the integral of radiosity less control variate over the hemisphere: the mean of several
/// sets of rays, until the noise is low enough. `variance`: of the light so far; gains the rays'.
RayEnds PointGather::Impl::add_hemisphere(const Vec3& p, const Vec3& n, std::uint32_t own,
                                          Random& random,
                                          const EmitterSampler::ControlVariate& control,
                                          const Spectrum& emitted, Spectrum& variance,
                                          PointIrradiance& light) const {
  Spectrum& e = light.irradiance;
  const double dark = darkness(mean_irradiance, std::span(e).first(lead_bands));
  const Paths paths{picker.weights(p), far_sides(config.patch_error * dark)};
  Spectrum sum(bands, 0.0), of_rays(bands, 0.0);
  RayEnds ends;
  bool noisy = true;
  int rounds = 0;
  while (noisy && rounds < most_ray_sets) {
    const Spectrum more = add_rays(p, n, own, random, control, paths, sum, ends);
    ++rounds;
    noisy = false;
    for (std::size_t b = 0; b < bands; ++b) {
      of_rays[b] += more[b];
      const double found = e[b] + sum[b] / rounds;
      noisy |= b < lead_bands && config.least_noise() > 0.0 &&
               std::sqrt(of_rays[b]) / rounds > most_noise(b, found, found - emitted[b]);
    }
  }
  for (std::size_t b = 0; b < bands; ++b) {
    e[b] += sum[b] / rounds;
    variance[b] += of_rays[b] / (rounds * rounds);
  }
  const int side = std::max(1, static_cast<int>(std::lround(std::sqrt(config.rays_in_set()))));
  light.front_share = static_cast<double>(ends.front) / (rounds * side * side);
  light.back_share = static_cast<double>(ends.back) / (rounds * side * side);
  return ends;
}

PointGather::Impl::Impl(std::span<const ClusterState> of, std::span<const LightSource> by,
                        const Occluders& between, const PointGatherConfig& how)
    : clusters(of),
      lights(by),
      occluders(&between),
      config(how),
      emitters(of, between),
      picker(emitters.bright(), by, between, how.seed),
      bands(of.empty() ? 1 : static_cast<std::size_t>(of[0].bands())),
      lead_bands(of.empty() ? 1 : static_cast<std::size_t>(of[0].patches().lead_bands())),
      mean_irradiance(mean_irradiance_over(of)),
      mean_link_error(mean_link_error_over(of)) {}

PointGather::PointGather(std::span<const ClusterState> clusters,
                         std::span<const LightSource> lights, const Occluders& occluders,
                         const PointGatherConfig& config)
    : impl_(std::make_unique<Impl>(clusters, lights, occluders, config)) {}

PointGather::~PointGather() = default;

PointIrradiance PointGather::at(const Vec3& p, const Vec3& n) const {
  // Seeded for each point: the answer does not depend on the points before it.
  Random random(impl_->config.seed);
  PointIrradiance light;
  light.irradiance = light.error = light.noise = light.direct = Spectrum(impl_->bands, 0.0);
  Spectrum& e = light.irradiance;
  const std::uint32_t own = surface_at(*impl_->occluders, p, n);
  const Vec3 x = lifted(*impl_->occluders, p, n);
  Spectrum variance(impl_->bands, 0.0), emitted(impl_->bands, 0.0);
  impl_->add_lights({x, n, own, RayStart::in_air}, emitted, variance);
  for (std::size_t b = 0; b < impl_->bands; ++b) e[b] += emitted[b];
  const int rays = impl_->config.rays_in_set();
  const EmitterSampler::Survey survey =
      impl_->emitters.survey(x, n, own, std::min(rays, most_survey_rays), random);
  const EmitterSampler::ControlVariate control = impl_->emitters.add_control_variate(
      x, n, own, survey, rays, least_share(impl_->config), random, e, variance);
  impl_->emitters.add_emitted(control, emitted);
  light.direct = emitted;
  const RayEnds ends = impl_->add_hemisphere(x, n, own, random, control, emitted, variance, light);
  const double doubt = ends.doubt(impl_->mean_link_error);
  for (std::size_t b = 0; b < impl_->bands; ++b) {
    if (e[b] < rounding * control.ambient[b]) e[b] = 0.0;
    light.noise[b] = std::sqrt(variance[b]);
    light.error[b] =
        std::hypot(light.noise[b], impl_->reflected_error(b, doubt * (e[b] - emitted[b])));
  }
  return light;
}

Spectrum PointGather::from_patches(const Vec3& p, const Vec3& n) const {
  Spectrum e(impl_->bands, 0.0);
  std::uint32_t polygon = surface_at(*impl_->occluders, p, n);
  if (polygon == RayScene::no_polygon) {
    const RayHit hit = impl_->occluders->rays().closest(p, -n);
    if (!hit.any() || !hit.front) return e;
    polygon = hit.polygon;
  }
  const PolygonRef ref = impl_->occluders->local(polygon);
  impl_->clusters[ref.cluster.index()].patches().evaluate(false, ref.polygon, p, e);
  return e;
}

Spectrum PointGather::radiosity(std::uint32_t polygon, const Vec3& p) const {
  Spectrum b(impl_->bands, 0.0);
  const PolygonRef ref = impl_->occluders->local(polygon);
  impl_->clusters[ref.cluster.index()].patches().evaluate(true, ref.polygon, p, b);
  return b;
}

}  // namespace enfilade
