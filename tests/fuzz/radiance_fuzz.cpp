// The Radiance importer: any bytes give a scene or an InputError.
#include <cmath>

#include "base/error.hpp"
#include "fuzz_target.hpp"
#include "import/radiance/radiance_import.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  const fuzz::InputFile file(data, size, ".rad");
  Warnings warnings;
  try {
    for (const Surface& surface : import_radiance({file.path()}, {}, warnings).surfaces) {
      for (const double r : surface.reflectance) fuzz::require(r >= 0.0 && r < 1.0);
      for (const double e : surface.exitance) fuzz::require(e >= 0.0 && std::isfinite(e));
    }
  } catch (const InputError&) {
  }
  return 0;
}
