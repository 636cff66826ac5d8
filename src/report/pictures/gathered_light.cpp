#include "report/pictures/gathered_light.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/random.hpp"
#include "base/run_on_threads.hpp"
#include "base/usable_cores.hpp"

namespace enfilade {
namespace {

/// The light at a pixel is a mean of the places around it, by a Gaussian of so many steps of their
/// grid, cut off at two of its widths. Reflected light is even, and its rays are noisy;
/// the shadows of lamps are sharp.
constexpr double reflected_width = 1.2, direct_width = 0.8, cut_off = 2.0;
/// Of light from a place that no other is near to, in units of a place at the pixel itself.
constexpr double least_weight = 1e-4;
/// cos of the angle between surfaces that count as one plane.
constexpr double same_direction = 0.999;

}  // namespace

PictureLight::PictureLight(const SolvedScene& solved, const CameraView& view, int width, int height,
                           const GatherQuality& quality, const Progress& progress)
    : solved_(solved),
      width_(width),
      height_(height),
      bands_(solved.states.empty() ? 1 : static_cast<std::size_t>(solved.states[0].bands())),
      tolerance_m_(1e-5 * solved.occluders.extent_m()) {
  const int threads = quality.threads > 0 ? quality.threads : usable_cores();
  std::vector<Pixel> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::atomic<int> next_row{0};
  run_on_threads(threads, [&](bool) {
    for (int y = next_row++; y < height; y = next_row++) {
      for (int x = 0; x < width; ++x) {
        const CameraView::Seen seen =
            view.at(2.0 * (x + 0.5) / width - 1.0, 1.0 - 2.0 * (y + 0.5) / height);
        if (seen.what != CameraView::Seen::What::front) continue;
        pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x)] = {seen.polygon, seen.p};
      }
    }
  });
  direct_.width_steps = direct_width;
  reflected_.width_steps = reflected_width;
  find_places(direct_, quality.direct_px, pixels);
  find_places(reflected_, quality.every_px, pixels);
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
          add(layer.points[k], frame_of(place.polygon).n, place.polygon, random,
              std::span(layer.light).subspan(place.light, bands_));
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

const PolygonFrame& PictureLight::frame_of(std::uint32_t polygon) const {
  const PolygonRef ref = solved_.occluders.local(polygon);
  return solved_.states[ref.cluster.index()].patches().frames()[ref.polygon];
}

/// True where p, on polygon a, lies in the plane of b.
bool PictureLight::same_plane(std::uint32_t a, std::uint32_t b, const Vec3& p) const {
  if (a == b) return true;
  const PolygonFrame& other = frame_of(b);
  return glm::dot(frame_of(a).n, other.n) > same_direction &&
         std::abs(glm::dot(p - other.origin, other.n)) < tolerance_m_;
}

/// In each cell of the grid, for each plane that its pixels show, the pixel nearest to the cell's
/// middle.
void PictureLight::find_places(Layer& layer, int step_px, const std::vector<Pixel>& pixels) {
  layer.step_px = step_px;
  layer.columns = (width_ + step_px - 1) / step_px;
  layer.rows = (height_ + step_px - 1) / step_px;
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
      const std::size_t begin = layer.places.size();
      layer.first.push_back(begin);
      for (const auto& [dx, dy] : order) {
        const int x = column * step_px + dx, y = row * step_px + dy;
        if (x >= width_ || y >= height_) continue;
        const Pixel& pixel = pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                    static_cast<std::size_t>(x)];
        if (pixel.polygon == RayScene::no_polygon) continue;
        const bool known = std::any_of(
            layer.places.begin() + static_cast<std::ptrdiff_t>(begin), layer.places.end(),
            [&](const Place& p) { return same_plane(pixel.polygon, p.polygon, pixel.p); });
        if (known) continue;
        layer.places.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                                pixel.polygon, layer.light.size()});
        layer.points.push_back(pixel.p);
        layer.light.resize(layer.light.size() + bands_, 0.0);
      }
    }
  }
  layer.first.push_back(layer.places.size());
}

bool PictureLight::add(const Layer& layer, double x, double y, const Vec3& p, std::uint32_t polygon,
                       std::span<double> e) const {
  const int column = static_cast<int>(x) / layer.step_px, row = static_cast<int>(y) / layer.step_px;
  const double narrow = 1.0 / (2.0 * std::pow(layer.width_steps * layer.step_px, 2));
  const int cells_around = static_cast<int>(std::lround(cut_off * layer.width_steps));
  double total = 0.0;
  std::vector<double> sum(e.size(), 0.0);
  const int left = std::max(column - cells_around, 0),
            right = std::min(column + cells_around, layer.columns - 1);
  for (int j = std::max(row - cells_around, 0); j <= std::min(row + cells_around, layer.rows - 1);
       ++j) {
    const std::size_t cell = static_cast<std::size_t>(j) * static_cast<std::size_t>(layer.columns);
    for (std::size_t i = layer.first[cell + static_cast<std::size_t>(left)];
         i < layer.first[cell + static_cast<std::size_t>(right) + 1]; ++i) {
      const Place& place = layer.places[i];
      if (!same_plane(polygon, place.polygon, p)) continue;
      const double dx = x - place.x, dy = y - place.y;
      const double weight = std::exp(-narrow * (dx * dx + dy * dy));
      total += weight;
      for (std::size_t band = 0; band < e.size(); ++band)
        sum[band] += weight * layer.light[place.light + band];
    }
  }
  if (total < least_weight) return false;
  for (std::size_t band = 0; band < e.size(); ++band) e[band] += sum[band] / total;
  return true;
}

bool PictureLight::at(double x, double y, const Vec3& p, std::uint32_t polygon,
                      std::span<double> e) const {
  std::ranges::fill(e, 0.0);
  return add(direct_, x, y, p, polygon, e) && add(reflected_, x, y, p, polygon, e);
}

}  // namespace enfilade
