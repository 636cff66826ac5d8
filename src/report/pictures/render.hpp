// Pictures by rays from the eye: the light on the patches, or one gather a pixel.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "report/pictures/camera.hpp"
#include "report/pictures/solved_scene.hpp"

namespace enfilade {

struct RenderConfig {
  int width = 960, height = 540;
  int samples =
      4;  ///< rays per pixel, on a jittered grid; one where no edge is near (first_surfaces.hpp)
  /// Rays over the hemisphere of each place at which light is gathered from the solution
  /// (gathered_light.hpp), so that no patches show; 0 = the light of the patches.
  int gather_rays = 64;
  int gather_every_px = 8;  ///< distance of these places in the picture
  int direct_every_px = 4;  ///< of those where the shadows of lamps are found, if it is less
  bool smooth = true;       ///< without gathering: radiosity without the patches' edges
                            ///< (smooth_light.hpp); irradiance is left as it is
  int threads = 0;          ///< 0 = as many as the machine has
  std::uint64_t seed = 1;
};

/// Radiosity (of the sky: pi times its luminance) and irradiance of each pixel, as red, green and
/// blue (see display_rgb), rows from the top.
struct LightImage {
  struct Pixel {
    float radiosity[3] = {0, 0, 0};
    float irradiance = 0;  ///< as one value (one_value.hpp)
    float cover = 0;       ///< share of the samples that met a surface
    float sky = 0;         ///< share that left the building under its sky
    float section = 0;     ///< share that met the inside of a solid at the cut
  };
  int width = 0, height = 0;
  std::size_t gathered_places = 0;  ///< at which light was gathered; 0 = light of the patches
  std::vector<Pixel> pixels;
};

LightImage render(const SolvedScene& solved, const Camera& camera, const RenderConfig& config,
                  const Progress& progress = {});

/// Bands as red, green, blue: 1 = grey, 3 = as they are, else the means of the lower, middle and
/// upper third.
std::array<double, 3> display_rgb(std::span<const double> bands);

}  // namespace enfilade
