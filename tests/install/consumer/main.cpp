// Reads a scene through the installed package and prints how many cells its space falls into.
#include <iostream>

#include "cells/partition/cell_complex.hpp"
#include "cells/rooms/build_cells.hpp"
#include "occluders/occluders.hpp"
#include "scene_file/scene_io.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  enfilade::Warnings warnings;
  const enfilade::Scene scene = enfilade::read_scene(argv[1], warnings);
  const auto pieces = enfilade::make_pieces(scene, warnings);
  const auto cells = enfilade::build_cells(pieces, {});
  std::cout << scene.surfaces.size() << " surfaces, " << cells.cells().size() << " cells\n";
  return cells.cells().empty() ? 1 : 0;
}
