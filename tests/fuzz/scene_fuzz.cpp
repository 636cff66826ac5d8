// The scene reader and the making of pieces: any bytes give a scene or an InputError.
#include <cmath>

#include "base/error.hpp"
#include "fuzz_target.hpp"
#include "scene_file/scene_io.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  const fuzz::InputFile file(data, size, ".json");
  Warnings warnings;
  try {
    const Scene scene = read_scene(file.path(), warnings);
    for (const Surface& surface : scene.surfaces) {
      fuzz::require(surface.reflectance.size() == static_cast<std::size_t>(scene.bands));
      fuzz::require(surface.exitance.size() == static_cast<std::size_t>(scene.bands));
    }
    for (const Piece& piece : make_pieces(scene, warnings)) {
      fuzz::require(piece.polygon.size() >= 3 && std::isfinite(area_m2(piece.polygon)));
    }
  } catch (const InputError&) {
  }
  return 0;
}
