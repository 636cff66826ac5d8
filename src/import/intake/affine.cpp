#include "import/intake/affine.hpp"

namespace enfilade {

Affine to_scene(const ImportOptions& options, char up, double metres_per_unit) {
  double metres = metres_per_unit;
  for (const auto& [name, length] :
       {std::pair{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}, {"in", 0.0254}}) {
    if (options.units == name) metres = length;
  }
  if (!options.up.empty()) up = options.up[0];
  // The columns are the images of the model's axes.
  const glm::dmat3 turn =
      up == 'y' ? glm::dmat3(Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, -1, 0)) : glm::dmat3(1.0);
  return {metres * options.scale * turn, Vec3(0.0)};
}

}  // namespace enfilade
