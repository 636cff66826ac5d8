#include "import/ifc/ifc_import.hpp"

#include "base/error.hpp"
#include "import/ifc/ifc_answer.hpp"
#include "import/ifc/ifc_program.hpp"
#include "json/model_files.hpp"

namespace enfilade {

Scene import_ifc(const std::string& path, const ImportOptions& options, Warnings& warnings) {
  if (!options.units.empty() || !options.up.empty()) {
    throw InputError(path, "file", "an IFC model names its own unit and has z up",
                     "leave --units and --up out");
  }
  ModelFiles files(path, options.allow_outside);
  Scene scene =
      scene_from_ifc_answer(run_ifc_program(path, files.read_model()), path, options, warnings);
  scene.hash = files.hash();
  return scene;
}

}  // namespace enfilade
