// The probe file's reader, of JSON and of tables: any bytes give probes within the limits or an
// InputError.
#include "base/error.hpp"
#include "base/limits.hpp"
#include "fuzz_target.hpp"
#include "scene_file/scene_io.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  for (const char* ending : {".json", ".csv"}) {
    const fuzz::InputFile file(data, size, ending);
    try {
      for (const Probe& probe : read_probes(file.path()).probes) {
        fuzz::require(!limits::fault_of_place(probe.p));
        fuzz::require(std::abs(glm::length(probe.n) - 1.0) < 1e-9);
      }
    } catch (const InputError&) {
    }
  }
  return 0;
}
