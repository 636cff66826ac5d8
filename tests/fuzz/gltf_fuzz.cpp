// The glTF importer, of text and binary: any bytes give a scene within the limits or an InputError.
#include "fuzz_target.hpp"
#include "import/gltf/gltf_import.hpp"
#include "model_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const fuzz::InputFile file(bytes, bytes.starts_with("glTF") ? ".glb" : ".gltf");
  fuzz::check_model([&](Warnings& warnings) { return import_gltf(file.path(), {}, warnings); });
  return 0;
}
