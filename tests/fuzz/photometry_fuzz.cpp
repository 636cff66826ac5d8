// The readers of photometric files: any bytes give a distribution with flux or an InputError.
#include <cmath>

#include "base/error.hpp"
#include "fuzz_target.hpp"
#include "photometry/files/photometric_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  for (const char* name : {"input.ies", "input.ldt"}) {
    Warnings warnings;
    try {
      const PhotometricFile file = read_photometric_file(bytes, name, warnings);
      const double flux = file.distribution->flux();
      fuzz::require(flux > 0.0 && std::isfinite(flux));
      fuzz::require(std::isfinite(file.distribution->intensity({0.3, -0.2, 0.7})));
      for (const auto& face : file.opening.faces()) {
        for (const Vec3& corner : face)
          fuzz::require(std::isfinite(corner.x + corner.y + corner.z));
      }
    } catch (const InputError&) {
    }
  }
  return 0;
}
