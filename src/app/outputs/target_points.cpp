#include "app/outputs/target_points.hpp"

#include "solver/importance.hpp"

namespace enfilade {

Warnings blind_target_points(const std::string& file, std::span<const Probe> points,
                             const Prepared& prepared) {
  Warnings warnings;
  if (points.empty()) return warnings;
  const std::size_t blind = blind_points(points, prepared.scene, Occluders(prepared.clusters));
  if (blind == 0) return warnings;
  warnings.add(file, std::to_string(blind) + " of " + std::to_string(points.size()) +
                         " points see nothing, or mostly backs, as in a wall or under a floor: "
                         "the error there is not held; move them into a room");
  return warnings;
}

}  // namespace enfilade
