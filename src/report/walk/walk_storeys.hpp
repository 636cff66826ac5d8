// Which storey each surface belongs to, so that a page can leave storeys out.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/pictures/solved_scene.hpp"
#include "report/survey/building_rooms.hpp"

namespace enfilade {

struct WalkStorey {
  std::string name;      ///< as its rooms tell it, else "Storey 1"...
  double floor_m = 0.0;  ///< height of its floor
  double cut_m = 0.0;    ///< below its ceilings: what lies above hides the rooms from above
};

/// The storeys that the rooms name, else those that are found from the floors
/// (report/plans/storeys.hpp), lowest first.
class WalkStoreys {
 public:
  WalkStoreys(const SolvedScene& solved, std::span<const SurveyRoom> rooms);
  const std::vector<WalkStorey>& all() const { return storeys_; }
  /// Returns the storey that p lies in, by its height.
  std::size_t of(const Vec3& p) const { return at(p.z); }
  /// Returns the storey of a room, by its name.
  std::size_t of(const SurveyRoom& room) const;
  /// Returns the storey of a polygon: that of the room of the building which its front looks into
  /// where that is within one storey, else by its own height.
  std::size_t of(const Cluster& cluster, std::uint32_t polygon) const;

 private:
  std::size_t at(double height_m) const;
  const CellComplex& cells_;
  std::vector<WalkStorey> storeys_;
};

}  // namespace enfilade
