#include "report/pictures/first_surfaces.hpp"

#include <atomic>
#include <cmath>

#include "base/random.hpp"
#include "base/run_on_threads.hpp"
#include "base/usable_cores.hpp"

namespace enfilade {

PixelSample pixel_sample(std::uint64_t seed, std::size_t pixel, int number) {
  Random random(seed * 0x9E3779B97F4A7C15ull + pixel);
  const double shift_x = random.uniform(), shift_y = random.uniform(), i = number + 0.5;
  return {{std::fmod(shift_x + i * 0.7548776662466927, 1.0),
           std::fmod(shift_y + i * 0.5698402909980532, 1.0)},
          std::fmod(shift_x + shift_y + i * 0.6180339887498949, 1.0)};
}

FirstSurfaces::FirstSurfaces(const CameraView& view, int width, int height, int threads,
                             std::uint64_t seed)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
  std::atomic<int> next_row{0};
  run_on_threads(threads > 0 ? threads : usable_cores(), [&](bool) {
    for (int y = next_row++; y < height; y = next_row++) {
      for (int x = 0; x < width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x);
        const Vec2 at = Vec2(x, y) + pixel_sample(seed, i, 0).at;
        const CameraView::Seen seen = view.at(2.0 * at.x / width - 1.0, 1.0 - 2.0 * at.y / height);
        pixels_[i] = {seen.polygon, seen.what, seen.panes.empty() && seen.outward == Vec3(0.0),
                      seen.p};
      }
    }
  });
}

}  // namespace enfilade
