#include "report/walk/light_channels.hpp"

#include <algorithm>
#include <array>

#include "report/pictures/render.hpp"
#include "scene/equal_bands.hpp"
#include "scene/photopic.hpp"

namespace enfilade {
namespace {

/// True where red, green and blue are one solved band.
bool grey(const Scene& scene) {
  if (bands_of_file(scene) == 1) return true;
  const auto& of = scene.band_of;
  return !of.empty() &&
         std::ranges::all_of(of, [&](std::size_t band) { return band == of.front(); });
}

}  // namespace

LightChannels::LightChannels(const Scene& scene)
    : scene_(&scene), count_(grey(scene) ? 1 : 3), weights_(count_, 0.0) {
  const std::size_t bands = bands_of_file(scene);
  for (std::size_t band = 0; band < bands; ++band) {
    Spectrum one(bands, 0.0);
    one[band] = 1.0;
    // A band belongs to the first channel that it is part of; of two bands red and green are one.
    const std::array<double, 3> rgb = display_rgb(one);
    const std::size_t channel =
        count_ == 1 ? 0
                    : static_cast<std::size_t>(
                          std::ranges::find_if(rgb, [](double share) { return share > 0.0; }) -
                          rgb.begin());
    weights_[channel] += photopic(one, scene.unit) * per_lumen(scene.unit);
  }
}

void LightChannels::of(std::span<const double> solved, std::span<double> out) const {
  const std::array<double, 3> rgb = display_rgb(in_bands_of_file(*scene_, solved));
  std::copy_n(rgb.begin(), count_, out.begin());
}

}  // namespace enfilade
