#include "report/pictures/render.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "base/memory_wanted.hpp"
#include "base/random.hpp"
#include "base/run_on_threads.hpp"
#include "base/usable_cores.hpp"
#include "final_gather/point_gather.hpp"
#include "geometry/sampling.hpp"
#include "report/pictures/smooth_light.hpp"
#include "scene/equal_bands.hpp"

namespace enfilade {

namespace {

struct Ray {
  Vec3 from, direction;
};

/// The camera's axes, scaled so that picture coordinates in [-1, 1] give a ray.
class Lens {
 public:
  Lens(const Camera& camera, double aspect) : camera_(camera) {
    forward_ = glm::normalize(camera.look_at - camera.eye);
    Vec3 across = glm::cross(forward_, camera.up);
    // Looking along `up`: any horizontal will do.
    if (glm::length(across) < 1e-9) across = glm::cross(forward_, Vec3(0.0, 1.0, 0.0));
    if (glm::length(across) < 1e-9) across = Vec3(1.0, 0.0, 0.0);
    const double half = camera.parallel_height_m > 0.0
                            ? 0.5 * camera.parallel_height_m
                            : std::tan(0.5 * glm::radians(camera.vertical_angle_deg));
    right_ = glm::normalize(across) * (half * aspect);
    up_ = glm::normalize(glm::cross(across, forward_)) * half;
  }
  Ray ray(double x, double y) const {
    const Vec3 shift = x * right_ + y * up_;
    if (camera_.parallel_height_m > 0.0) return {camera_.eye + shift, forward_};
    return {camera_.eye, glm::normalize(forward_ + shift)};
  }

 private:
  const Camera& camera_;
  Vec3 forward_, right_, up_;
};

class Painter {
 public:
  Painter(const SolvedScene& solved, const Camera& camera, const RenderConfig& config)
      : solved_(solved),
        camera_(camera),
        config_(config),
        lens_(camera, static_cast<double>(config.width) / config.height) {
    for (const ClusterState& state : solved.states) polygons_ += state.patches().polygons();
    outer_ = std::make_unique<std::atomic<Outer>[]>(polygons_);
    if (config.gather_rays <= 0) return;
    PointGatherConfig gather;
    gather.rays = config.gather_rays;
    gather.noise = 0.0;  // a picture takes exactly gather_rays rays
    gather.seed = config.seed;
    gather_ =
        std::make_unique<PointGather>(solved.states, solved.scene.lights, solved.occluders, gather);
  }

  void paint_row(int y, LightImage& image) const {
    for (int x = 0; x < config_.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(config_.width) +
                             static_cast<std::size_t>(x);
      Random random(config_.seed * 0x9E3779B97F4A7C15ull + at);
      const double shift_x = random.uniform(), shift_y = random.uniform();
      Gathered gathered;
      std::uint32_t first = RayScene::no_polygon;
      int samples = 0;
      while (samples < config_.samples) {
        // The R2 sequence (Roberts 2018) covers a pixel evenly with any number of samples.
        const double i = samples + 0.5;
        const double dx = std::fmod(shift_x + i * 0.7548776662466927, 1.0);
        const double dy = std::fmod(shift_y + i * 0.5698402909980532, 1.0);
        const std::uint32_t seen = add(
            lens_.ray(2.0 * (x + dx) / config_.width - 1.0, 1.0 - 2.0 * (y + dy) / config_.height),
            std::fmod(shift_x + shift_y + i * 0.6180339887498949, 1.0), image.pixels[at], gathered);
        ++samples;
        // Two samples of one polygon: no edge crosses the pixel, most likely.
        if (samples == 1) first = seen;
        if (samples == 2 && seen == first) break;
      }
      scale(image.pixels[at], 1.0f / static_cast<float>(samples));
    }
  }

 private:
  static void scale(LightImage::Pixel& pixel, float factor) {
    for (float& r : pixel.radiosity) r *= factor;
    pixel.irradiance *= factor;
    pixel.cover *= factor;
    pixel.section *= factor;
  }

  struct Met {
    RayHit hit;
    Vec3 p{0.0};
  };

  /// The first visible polygon; of two that lie back to back in one place, the one that faces the
  /// eye.
  Met first_seen(const Ray& ray, std::uint32_t skip) const {
    const RayScene& rays = solved_.occluders.rays();
    Met met;
    met.hit = rays.closest(ray.from, ray.direction, skip);
    met.p = ray.from + met.hit.distance_m * ray.direction;
    if (!met.hit.any() || met.hit.front) return met;
    const double step_m = 4.0 * rays.epsilon_m();
    const RayHit twin =
        rays.closest(met.p - step_m * ray.direction, ray.direction, met.hit.polygon, 2.0 * step_m);
    if (twin.any() && twin.front) met.hit = twin;
    return met;
  }

  /// A pixel's gathers: one for each polygon in it, whatever the number of samples.
  using Gathered = std::vector<std::pair<std::uint32_t, Spectrum>>;
  const Spectrum& gather_once(std::uint32_t polygon, const Vec3& p, const Vec3& n,
                              Gathered& gathered) const {
    for (const auto& [known, e] : gathered) {
      if (known == polygon) return e;
    }
    return gathered.emplace_back(polygon, gather_->irradiance(p, n)).second;
  }

  /// Adds a sample; returns the polygon that it shows, none for the sky and the inside of a solid.
  std::uint32_t add(Ray ray, double turn, LightImage::Pixel& pixel, Gathered& gathered) const {
    constexpr std::uint32_t none = RayScene::no_polygon;
    if (camera_.cut_above_m && !go_to_cut(ray)) return none;
    std::uint32_t skip = RayScene::no_polygon;
    for (int culled = 0; culled < 256; ++culled) {
      const Met met = first_seen(ray, skip);
      if (!met.hit.any()) return none;
      if (camera_.cut_above_m && culled == 0 && !met.hit.front && inside_solid(ray.from)) {
        pixel.section += 1.0f;
        return none;
      }
      if (camera_.cut_above_m && (!met.hit.front || outer(met.hit.polygon))) {
        ray.from = met.p;
        skip = met.hit.polygon;
        continue;
      }
      Passage passage;
      if (solved_.occluders.panes().any())
        passage = add_panes(ray, met, skip, turn, pixel, gathered);
      if (met.hit.front) add_light(met, passage, turn, pixel, gathered);
      pixel.cover += 1.0f;
      return met.hit.polygon;
    }
    return none;
  }

  /// Moves a ray that starts above the cut down to it; false where it never comes there.
  bool go_to_cut(Ray& ray) const {
    const double above_m = ray.from.z - *camera_.cut_above_m;
    if (above_m <= 0.0) return true;
    if (ray.direction.z >= 0.0) return false;
    ray.from += above_m / -ray.direction.z * ray.direction;
    return true;
  }

  /// Within a closed solid everything around shows its back.
  bool inside_solid(const Vec3& p) const {
    const Vec3 around[] = {
        {0.9, 0.4, 0.1}, {-0.9, -0.3, 0.2}, {0.3, -0.9, 0.15}, {-0.4, 0.9, -0.2}, {0.1, 0.2, 1.0}};
    return std::all_of(std::begin(around), std::end(around), [&](const Vec3& d) {
      const RayHit hit = solved_.occluders.rays().closest(p, d);
      return hit.any() && !hit.front;
    });
  }

  /// A facade: upright or downward, with open sky or nothing before most of it. It hides the rooms
  /// in a cut-away.
  bool outer(std::uint32_t polygon) const {
    Outer known = outer_[polygon].load(std::memory_order_relaxed);
    if (known == Outer::unknown) {
      known = looks_outward(polygon) ? Outer::yes : Outer::no;
      outer_[polygon].store(known, std::memory_order_relaxed);
    }
    return known == Outer::yes;
  }
  bool looks_outward(std::uint32_t polygon) const {
    constexpr int looks = 24;
    const PolygonRef ref = solved_.occluders.local(polygon);
    const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
    const PolygonFrame& frame = forest.frames()[ref.polygon];
    if (frame.n.z > 0.5) return false;
    const Vec3 p = frame.at(forest.node(ref.polygon).shape.centroid);
    Random random(polygon + 1);
    int free = 0;
    for (int i = 0; i < looks; ++i) {
      const double z = 1.0 - 2.0 * random.uniform(), about = random.uniform();
      // Cosine-weighted: a point of the unit sphere that stands on the plane.
      const Vec3 d = 1.001 * frame.n + sphere_direction(z, about);
      free += !solved_.occluders.rays().closest(p, d, polygon).any();
    }
    return free > looks / 2;
  }

  /// Adds what the panes before what is seen send; returns what they pass.
  Passage add_panes(const Ray& ray, const Met& met, std::uint32_t skip, double turn,
                    LightImage::Pixel& pixel, Gathered& gathered) const {
    Passage passage;
    for (const PaneMet& pane :
         solved_.occluders.panes_along(ray.from, ray.direction, met.hit.distance_m, skip)) {
      passage = pane.behind;
      if (!pane.front) continue;
      const float behind = pixel.irradiance;  // that of what is seen through the pane counts
      const Met at{{pane.polygon, pane.distance_m, true},
                   ray.from + pane.distance_m * glm::normalize(ray.direction)};
      add_light(at, pane.before, turn, pixel, gathered);
      pixel.irradiance = behind;
    }
    return passage;
  }

  void add_light(const Met& met, const Passage& passage, double turn, LightImage::Pixel& pixel,
                 Gathered& gathered) const {
    const PolygonRef ref = solved_.occluders.local(met.hit.polygon);
    const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
    const PolygonFrame& frame = forest.frames()[ref.polygon];
    Spectrum e(static_cast<std::size_t>(forest.bands())), b(e.size());
    if (gather_) {
      e = gather_once(met.hit.polygon, met.p, frame.n, gathered);
    } else {
      forest.evaluate(false, ref.polygon, met.p, e);
    }
    b = e;
    if (!gather_ && config_.smooth) smooth_irradiance(forest, ref.polygon, met.p, turn, b);
    for (std::size_t i = 0; i < b.size(); ++i)
      b[i] = passage.band(i) * (frame.exitance[i] + frame.reflectance[i] * b[i]);
    e = in_bands_of_file(solved_.scene, e);
    const auto rgb = display_rgb(in_bands_of_file(solved_.scene, b));
    for (std::size_t c = 0; c < 3; ++c)
      pixel.radiosity[c] += static_cast<float>(std::max(0.0, rgb[c]));
    double mean = 0.0;
    for (double value : e) mean += value / static_cast<double>(e.size());
    pixel.irradiance += static_cast<float>(std::max(0.0, mean));
  }

  const SolvedScene& solved_;
  const Camera& camera_;
  const RenderConfig& config_;
  Lens lens_;
  enum class Outer : std::uint8_t { unknown, yes, no };
  std::size_t polygons_ = 0;
  std::unique_ptr<std::atomic<Outer>[]>
      outer_;  ///< filled as rays meet polygons; no value depends on which thread fills it
  std::unique_ptr<PointGather> gather_;
};

}  // namespace

std::array<double, 3> display_rgb(std::span<const double> bands) {
  const std::size_t n = bands.size();
  std::array<double, 3> rgb{};
  if (n == 0) return rgb;
  for (std::size_t c = 0; c < 3; ++c) {
    // At least one band each, so that two bands show as first, second, second.
    const std::size_t first = std::min(c * n / 3, n - 1);
    const std::size_t last = std::max(first + 1, (c + 1) * n / 3);
    for (std::size_t i = first; i < last; ++i)
      rgb[c] += bands[i] / static_cast<double>(last - first);
  }
  return rgb;
}

LightImage render(const SolvedScene& solved, const Camera& camera, const RenderConfig& config,
                  const Progress& progress) {
  const MemoryPurpose purpose("the picture");
  LightImage image;
  image.width = config.width;
  image.height = config.height;
  image.pixels.resize(static_cast<std::size_t>(config.width) *
                      static_cast<std::size_t>(config.height));
  const Painter painter(solved, camera, config);
  std::atomic<int> next_row{0};
  const auto work = [&](bool reports) {
    for (int y = next_row++; y < config.height; y = next_row++) {
      painter.paint_row(y, image);
      if (reports) report_progress(progress, "render", static_cast<double>(y) / config.height);
    }
  };
  const int wanted = config.threads > 0 ? config.threads : usable_cores();
  run_on_threads(wanted, work);
  return image;
}

}  // namespace enfilade
