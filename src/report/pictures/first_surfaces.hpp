// What the first ray through each pixel of a picture meets.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "report/pictures/camera_view.hpp"

namespace enfilade {

/// A place within a pixel, from its upper left corner, and a number in [0, 1) of its own.
struct PixelSample {
  Vec2 at{0.5};
  double turn = 0.0;
};

/// Sample `number` of the pixel, by the R2 sequence (Roberts 2018), which covers a pixel evenly
/// with any number of samples.
PixelSample pixel_sample(std::uint64_t seed, std::size_t pixel, int number);

/// One ray through each pixel, at its first sample: where the picture gathers light, and where it
/// needs no further sample.
class FirstSurfaces {
 public:
  struct Pixel {
    std::uint32_t polygon = RayScene::no_polygon;
    CameraView::Seen::What what = CameraView::Seen::What::nothing;
    /// False where panes stand before it, or where the sky shows: the ray tells more than is here.
    bool alone = false;
    Vec3 p{0.0};
  };

  /// `threads`: 0 = as many as the machine has.
  FirstSurfaces(const CameraView& view, int width, int height, int threads, std::uint64_t seed);

  int width() const { return width_; }
  int height() const { return height_; }
  const Pixel& at(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }
  /// True where all pixels around show the same polygon, or the same nothing, and nothing else: no
  /// edge crosses the pixel, most likely. `same` tells which two other polygons look like one.
  template <typename Same>
  bool even(int x, int y, const Same& same) const {
    const Pixel& middle = at(x, y);
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height_ - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width_ - 1); ++i) {
        const Pixel& other = at(i, j);
        if (!other.alone || other.what != middle.what) return false;
        if (other.polygon != middle.polygon && !same(other.polygon, middle.polygon)) return false;
      }
    }
    return true;
  }

 private:
  int width_, height_;
  std::vector<Pixel> pixels_;
};

}  // namespace enfilade
