// What the program that reads IFC hands over: any bytes give a scene within the limits or an
// InputError.
#include "fuzz_target.hpp"
#include "import/ifc/ifc_answer.hpp"
#include "model_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  const std::string answer(reinterpret_cast<const char*>(data), size);
  fuzz::check_model(
      [&](Warnings& warnings) { return scene_from_ifc_answer(answer, "model.ifc", {}, warnings); });
  return 0;
}
