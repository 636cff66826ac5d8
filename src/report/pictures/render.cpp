#include "report/pictures/render.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <numbers>

#include "base/memory_wanted.hpp"
#include "base/run_on_threads.hpp"
#include "base/usable_cores.hpp"
#include "report/pictures/camera_view.hpp"
#include "report/pictures/first_surfaces.hpp"
#include "report/pictures/gathered_light.hpp"
#include "report/pictures/one_value.hpp"
#include "report/pictures/smooth_light.hpp"
#include "scene/equal_bands.hpp"

namespace enfilade {

namespace {

class Painter {
 public:
  Painter(const SolvedScene& solved, const Camera& camera, const RenderConfig& config,
          const Progress& progress)
      : solved_(solved),
        config_(config),
        view_(solved, camera, static_cast<double>(config.width) / config.height) {
    Spectrum one(static_cast<std::size_t>(solved.scene.bands));
    for (std::size_t i = 0; i < one.size(); ++i) {
      one[i] = 1.0;
      weights_.push_back(
          {display_rgb(in_bands_of_file(solved.scene, one)), one_value(solved.scene, one)});
      one[i] = 0.0;
    }
    if (config.gather_rays <= 0) return;
    surfaces_ = std::make_unique<FirstSurfaces>(view_, config.width, config.height, config.threads,
                                                config.seed);
    GatherQuality quality;
    quality.rays = config.gather_rays;
    quality.every_px = config.gather_every_px;
    quality.direct_px = std::min(config.gather_every_px, config.direct_every_px);
    quality.threads = config.threads;
    quality.seed = config.seed;
    gathered_ = std::make_unique<PictureLight>(solved, *surfaces_, quality, progress);
  }

  std::size_t gathered_places() const { return gathered_ ? gathered_->places() : 0; }

  void paint_row(int y, LightImage& image) const {
    PixelPaint paint;
    for (int x = 0; x < config_.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(config_.width) +
                             static_cast<std::size_t>(x);
      paint.begin(x, y, image.pixels[at]);
      int samples = 0;
      std::uint32_t first = RayScene::no_polygon;
      // What the first ray has met needs no second one, where it tells all.
      const bool known = surfaces_ && surfaces_->at(x, y).alone;
      if (known) {
        const FirstSurfaces::Pixel& met = surfaces_->at(x, y);
        add({met.what, met.polygon, met.p}, pixel_sample(config_.seed, at, 0).turn, paint);
        ++samples;
        const auto same = [this](std::uint32_t a, std::uint32_t b) { return look_alike(a, b); };
        if (surfaces_->even(x, y, same)) continue;
      }
      while (samples < config_.samples) {
        const PixelSample sample = pixel_sample(config_.seed, at, samples);
        const Vec2 in_picture = Vec2(x, y) + sample.at;
        const CameraView::Seen seen = view_.at(2.0 * in_picture.x / config_.width - 1.0,
                                               1.0 - 2.0 * in_picture.y / config_.height);
        add(seen, sample.turn, paint);
        ++samples;
        if (known) continue;  // an edge is near: all samples count
        // Two samples of one polygon: no edge crosses the pixel, most likely. What shows outside
        // (sun, horizon, panes) has no number to tell it by.
        if (samples == 1) first = seen.polygon;
        if (samples == 2 && seen.polygon == first && first != RayScene::no_polygon) break;
      }
      scale(image.pixels[at], 1.0f / static_cast<float>(samples));
    }
  }

 private:
  /// True where no edge shows between two polygons: pieces of one wall.
  bool look_alike(std::uint32_t a, std::uint32_t b) const {
    if (!gathered_->same_plane(a, b)) return false;
    const PolygonFrame &one = frame_of(a), &other = frame_of(b);
    return one.reflectance == other.reflectance && one.exitance == other.exitance;
  }

  const PolygonFrame& frame_of(std::uint32_t polygon) const {
    const PolygonRef ref = solved_.occluders.local(polygon);
    return solved_.states[ref.cluster.index()].patches().frames()[ref.polygon];
  }

  static void scale(LightImage::Pixel& pixel, float factor) {
    for (float& r : pixel.radiosity) r *= factor;
    pixel.irradiance *= factor;
    pixel.cover *= factor;
    pixel.sky *= factor;
    pixel.section *= factor;
  }

  /// A pixel that is being painted, with the gathered light of a polygon: it is the same for all
  /// samples that show it.
  struct PixelPaint {
    int x = 0, y = 0;
    LightImage::Pixel* pixel = nullptr;
    std::uint32_t polygon = RayScene::no_polygon;
    Spectrum e, radiosity;
    void begin(int at_x, int at_y, LightImage::Pixel& of) {
      x = at_x;
      y = at_y;
      pixel = &of;
      polygon = RayScene::no_polygon;
    }
  };
  /// What one unit of a solved band adds to a pixel; all of these are linear.
  struct BandWeights {
    std::array<double, 3> rgb;
    double irradiance;
  };

  /// Adds a sample.
  void add(const CameraView::Seen& seen, double turn, PixelPaint& paint) const {
    using What = CameraView::Seen::What;
    LightImage::Pixel& pixel = *paint.pixel;
    if (seen.what == What::section) pixel.section += 1.0f;
    for (const CameraView::Seen::Pane& pane : seen.panes) {
      if (!pane.met.front) continue;
      const float behind = pixel.irradiance;  // that of what is seen through the pane counts
      PixelPaint of_pane;
      of_pane.begin(paint.x, paint.y, pixel);
      add_light({What::front, pane.met.polygon, pane.p}, pane.met.before, turn, of_pane);
      pixel.irradiance = behind;
    }
    const Passage passage = seen.panes.empty() ? Passage() : seen.panes.back().met.behind;
    if (seen.what == What::front) add_light(seen, passage, turn, paint);
    if (seen.what == What::front || seen.what == What::back) pixel.cover += 1.0f;
    if (seen.what == What::nothing && seen.outward != Vec3(0.0))
      add_sky(seen.outward, passage, pixel);
  }

  /// Finds the gathered light of `polygon`; false where there is none.
  bool find_gathered(std::uint32_t polygon, PixelPaint& paint) const {
    if (!gathered_) return false;
    if (paint.polygon == polygon) return true;
    paint.e.resize(bands());
    const bool found = gathered_->at(paint.x, paint.y, polygon, paint.e);
    paint.polygon = found ? polygon : RayScene::no_polygon;
    return found;
  }

  void add_sky(const Vec3& direction, const Passage& passage, LightImage::Pixel& pixel) const {
    Spectrum b = far_luminance(solved_.scene.lights, direction);
    if (b.empty()) return;
    for (std::size_t i = 0; i < b.size(); ++i) b[i] *= std::numbers::pi * passage.band(i);
    add_radiosity(b, pixel);
    pixel.sky += 1.0f;
  }

  void add_radiosity(const Spectrum& b, LightImage::Pixel& pixel) const {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (std::size_t i = 0; i < b.size(); ++i) sum += weights_[i].rgb[c] * b[i];
      pixel.radiosity[c] += static_cast<float>(std::max(0.0, sum));
    }
  }

  /// `passage`: what the panes before it pass.
  void add_light(const CameraView::Seen& seen, const Passage& passage, double turn,
                 PixelPaint& paint) const {
    const PolygonRef ref = solved_.occluders.local(seen.polygon);
    const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
    const PolygonFrame& frame = forest.frames()[ref.polygon];
    const bool gathered = find_gathered(seen.polygon, paint);
    Spectrum &e = paint.e, &b = paint.radiosity;
    e.resize(bands());
    if (!gathered) forest.evaluate(false, ref.polygon, seen.p, e);
    b = e;
    if (!gathered && config_.smooth) smooth_irradiance(forest, ref.polygon, seen.p, turn, b);
    for (std::size_t i = 0; i < b.size(); ++i)
      b[i] = passage.band(i) * (frame.exitance[i] + frame.reflectance[i] * b[i]);
    add_radiosity(b, *paint.pixel);
    double irradiance = 0.0;
    for (std::size_t i = 0; i < e.size(); ++i) irradiance += weights_[i].irradiance * e[i];
    paint.pixel->irradiance += static_cast<float>(std::max(0.0, irradiance));
  }

  std::size_t bands() const {
    return static_cast<std::size_t>(solved_.states.empty() ? 1 : solved_.states[0].bands());
  }

  const SolvedScene& solved_;
  const RenderConfig& config_;
  CameraView view_;
  std::vector<BandWeights> weights_;         // per band
  std::unique_ptr<FirstSurfaces> surfaces_;  // where light is gathered
  std::unique_ptr<PictureLight> gathered_;
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
  const Painter painter(solved, camera, config, progress);
  image.gathered_places = painter.gathered_places();
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
