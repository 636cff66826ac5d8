// A building's description: any bytes give a building or an InputError.
#include "base/error.hpp"
#include "building_file/description.hpp"
#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  try {
    describe_building(std::string(reinterpret_cast<const char*>(data), size), "building");
  } catch (const InputError&) {
  }
  return 0;
}
