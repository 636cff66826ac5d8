// A building's surfaces, made storey by storey: a building of any size in little memory.
#pragma once

#include "modeler/building.hpp"
#include "modeler/surface_sink.hpp"

namespace enfilade {

struct GeneratedCounts {
  std::size_t surfaces = 0, lights = 0;  ///< lights are the surfaces that emit
  std::size_t rooms = 0;                 ///< with stairwells' storeys, without corridors
};

/// Checks the whole building (InputError) before the first surface is handed to `receive`. Probes
/// are those that the building asks for.
GeneratedCounts generate_building(const Building& building, const SurfaceSink::Receiver& receive,
                                  std::vector<Probe>* probes = nullptr);

/// Makes the building as a scene in memory.
Scene building_scene(const Building& building);

}  // namespace enfilade
