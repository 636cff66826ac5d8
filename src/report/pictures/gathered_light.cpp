#include "report/pictures/gathered_light.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/random.hpp"
#include "base/run_on_threads.hpp"
#include "base/usable_cores.hpp"
#include "report/pictures/plane_numbers.hpp"

namespace enfilade {
namespace {

/// The light at a pixel is a mean of the places around it, by a Gaussian of so many steps of their
/// grid, cut off at two of its widths. Reflected light is even, and its rays are noisy;
/// the shadows of lamps are sharp.
constexpr double reflected_width = 1.2, direct_width = 0.8, cut_off = 2.0;
/// Of light from a place that no other is near to, in units of a place at the pixel itself.
constexpr double least_weight = 1e-4;

/// So many cells to each side of a pixel's own count for its light.
int cells_around(double width_steps) {
  return static_cast<int>(std::lround(cut_off * width_steps));
}

}  // namespace

PictureLight::PictureLight(const SolvedScene& solved, const FirstSurfaces& surfaces,
                           const GatherQuality& quality, const Progress& progress)
    : solved_(solved),
      bands_(solved.states.empty() ? 1 : static_cast<std::size_t>(solved.states[0].bands())),
      planes_(plane_numbers(solved, 1e-5 * solved.occluders.extent_m())) {
  const int threads = quality.threads > 0 ? quality.threads : usable_cores();
  direct_.width_steps = direct_width;
  reflected_.width_steps = reflected_width;
  find_places(direct_, quality.direct_px, surfaces);
  find_places(reflected_, quality.every_px, surfaces);
  const QuickGather gather(solved, quality.rays);
  const auto fill = [&](Layer& layer, auto&& add) {
    std::atomic<std::size_t> next{0};
    run_on_threads(threads, [&](bool reports) {
      constexpr std::size_t batch = 256;
      for (std::size_t i = next.fetch_add(batch); i < layer.places.size();
           i = next.fetch_add(batch)) {
        for (std::size_t k = i; k < std::min(i + batch, layer.places.size()); ++k) {
          Random random(quality.seed * 0x9E3779B97F4A7C15ull + k);
          const Place& place = layer.places[k];
          const PolygonRef ref = solved_.occluders.local(place.polygon);
          const PatchForest& forest = solved_.states[ref.cluster.index()].patches();
          add(place.p, forest.frames()[ref.polygon].n, place.polygon, random,
              std::span(layer.light).subspan(k * bands_, bands_));
        }
        if (reports)
          report_progress(progress, "gather",
                          static_cast<double>(i) / static_cast<double>(layer.places.size()));
      }
    });
  };
  fill(direct_, [&](auto&&... of) { gather.add_direct(of...); });
  fill(reflected_, [&](auto&&... of) { gather.add_reflected(of...); });
}

/// In each cell of the grid, for each plane that its pixels show, the pixel nearest to the cell's
/// middle.
void PictureLight::find_places(Layer& layer, int step_px, const FirstSurfaces& surfaces) const {
  layer.step_px = step_px;
  layer.columns = (surfaces.width() + step_px - 1) / step_px;
  layer.rows = (surfaces.height() + step_px - 1) / step_px;
  const double width_px = layer.width_steps * step_px;
  for (int d = 0; d < (cells_around(layer.width_steps) + 1) * step_px; ++d)
    layer.gaussian.push_back(std::exp(-d * d / (2.0 * width_px * width_px)));
  std::vector<std::pair<int, int>> order;
  for (int y = 0; y < step_px; ++y) {
    for (int x = 0; x < step_px; ++x) order.emplace_back(x, y);
  }
  const auto off = [&](const std::pair<int, int>& at) {
    return std::abs(2 * at.first + 1 - step_px) + std::abs(2 * at.second + 1 - step_px);
  };
  std::ranges::stable_sort(order, {}, off);
  for (int row = 0; row < layer.rows; ++row) {
    for (int column = 0; column < layer.columns; ++column) {
      const auto begin = static_cast<std::ptrdiff_t>(layer.places.size());
      layer.first.push_back(layer.places.size());
      for (const auto& [dx, dy] : order) {
        const int x = column * step_px + dx, y = row * step_px + dy;
        if (x >= surfaces.width() || y >= surfaces.height()) continue;
        const FirstSurfaces::Pixel& pixel = surfaces.at(x, y);
        if (pixel.what != CameraView::Seen::What::front) continue;
        const std::uint32_t plane = planes_[pixel.polygon];
        const auto known = std::ranges::find(layer.places.begin() + begin, layer.places.end(),
                                             plane, &Place::plane);
        if (known == layer.places.end())
          layer.places.push_back({x, y, plane, pixel.polygon, pixel.p});
      }
    }
  }
  layer.first.push_back(layer.places.size());
  layer.light.resize(layer.places.size() * bands_, 0.0);
}

bool PictureLight::add(const Layer& layer, int x, int y, std::uint32_t plane,
                       std::span<double> e) const {
  const int column = x / layer.step_px, row = y / layer.step_px;
  const int around = cells_around(layer.width_steps);
  const int left = std::max(column - around, 0),
            right = std::min(column + around, layer.columns - 1);
  double total = 0.0;
  thread_local Spectrum sum;
  sum.assign(bands_, 0.0);
  for (int j = std::max(row - around, 0); j <= std::min(row + around, layer.rows - 1); ++j) {
    const std::size_t cell = static_cast<std::size_t>(j) * static_cast<std::size_t>(layer.columns);
    for (std::size_t i = layer.first[cell + static_cast<std::size_t>(left)];
         i < layer.first[cell + static_cast<std::size_t>(right) + 1]; ++i) {
      const Place& place = layer.places[i];
      if (place.plane != plane) continue;
      const double weight = layer.gaussian[static_cast<std::size_t>(std::abs(x - place.x))] *
                            layer.gaussian[static_cast<std::size_t>(std::abs(y - place.y))];
      total += weight;
      for (std::size_t band = 0; band < bands_; ++band)
        sum[band] += weight * layer.light[i * bands_ + band];
    }
  }
  if (total < least_weight) return false;
  for (std::size_t band = 0; band < bands_; ++band) e[band] += sum[band] / total;
  return true;
}

bool PictureLight::at(int x, int y, std::uint32_t polygon, std::span<double> e) const {
  std::ranges::fill(e, 0.0);
  const std::uint32_t plane = planes_[polygon];
  return add(direct_, x, y, plane, e) && add(reflected_, x, y, plane, e);
}

}  // namespace enfilade
