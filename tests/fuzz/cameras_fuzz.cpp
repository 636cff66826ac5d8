// The camera file's reader: any bytes give cameras that a picture can be taken with, or an
// InputError.
#include "base/error.hpp"
#include "base/limits.hpp"
#include "fuzz_target.hpp"
#include "report/pictures/camera.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  const fuzz::InputFile file(data, size, ".json");
  try {
    for (const Camera& camera : read_cameras(file.path())) {
      fuzz::require(!limits::fault_of_place(camera.eye) && !limits::fault_of_place(camera.look_at));
      fuzz::require(glm::length(camera.look_at - camera.eye) > 0.0);
      fuzz::require(camera.vertical_angle_deg > 0.0 && camera.vertical_angle_deg < 180.0);
    }
  } catch (const InputError&) {
  }
  return 0;
}
