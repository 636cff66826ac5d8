// The OBJ importer with a library of materials and a texture: any bytes give a scene within the
// limits or an InputError. A line "%%%" ends the model, a second one the library.
#include "fuzz_target.hpp"
#include "import/obj/obj_import.hpp"
#include "model_fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace enfilade;
  std::string rest(reinterpret_cast<const char*>(data), size);
  const auto next = [&rest] {
    static const std::string end = "\n%%%\n";
    const std::size_t at = rest.find(end);
    std::string part = rest.substr(0, at);
    rest.erase(0, at == std::string::npos ? rest.size() : at + end.size());
    return part;
  };
  const fuzz::InputFile file(next(), ".obj");
  file.put_beside("m.mtl", next());
  file.put_beside("t.png", next());
  fuzz::check_model([&](Warnings& warnings) { return import_obj(file.path(), {}, warnings); });
  return 0;
}
