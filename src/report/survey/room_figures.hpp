// The light in rooms: illuminance in the working plane, on walls and ceiling, cylindrical, each
// with its estimated error (EN 12464-1).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "final_gather/point_gather.hpp"
#include "report/pictures/solved_scene.hpp"
#include "report/survey/building_rooms.hpp"
#include "report/survey/calculation_grid.hpp"

namespace enfilade {

/// A value and one standard deviation of it, in the scene's unit.
struct Estimate {
  double value = 0.0, error = 0.0;
};

/// What a survey reads: the solution, and a gatherer over it. Several bands count as one value
/// (one_value.hpp).
struct SurveyedScene {
  const SolvedScene& solved;
  const PointGather& gather;
  double patch_error = 0.0;  ///< relative error of what is read off patches
};

struct SurveyConfig {
  double plane_m = 0.75;       ///< of the working plane above the floor
  double cylindrical_m = 1.2;  ///< of the points of cylindrical illuminance above the floor
  bool cylindrical = true;
  /// All light is multiplied by it: what is left of a new installation's light before it is
  /// maintained (EN 12464-1, maintenance factor).
  double maintenance_factor = 1.0;
};

struct GridValue {
  Vec2 p{0.0};
  int cell = 0;  ///< of the grid (CalculationGrid::cell)
  double value = 0.0, error = 0.0;
};

struct RoomFigures {
  SurveyRoom room;
  CalculationGrid grid;
  double plane_m = 0.0;  ///< above the floor: as asked, and at most half of the room's height
  std::size_t in_furniture = 0, without_floor = 0;  ///< grid points that were left out
  std::vector<GridValue> values;                    ///< of the points that count
  /// Of the values; none where no point counts. U0 is the minimum by the mean.
  std::optional<Estimate> mean, minimum, maximum, u0;
  /// The error is that of the points in the middle, as if all of it were common to all points.
  std::optional<Estimate> median;
  /// Means over area, read off the patches; none where rays find no such surface.
  std::optional<Estimate> walls, ceiling;
  /// Mean over the grid's points of the mean vertical illuminance over four directions or more; the
  /// error counts that they are few.
  std::optional<Estimate> cylindrical;
};

/// True where p lies above the room's plan, between floor and ceiling.
bool lies_in(const RoomFigures& room, const Vec3& p);

/// Whether the mean reaches what is asked for: met, not met, or too near to say, within two
/// standard deviations.
enum class Verdict { none_asked, met, not_met, within_error };
Verdict verdict_of(const RoomFigures& room);
/// "", "met", "not met", "within error".
const char* name_of(Verdict verdict);

/// Surveys the rooms on all cores. The error of a mean takes the noise of its points as independent
/// and the error of the reflected light as common to all points, so that the latter does not
/// average out; that of U0 takes the two of minimum and mean as independent, so that neither
/// cancels.
std::vector<RoomFigures> survey_rooms(const SurveyedScene& scene, std::vector<SurveyRoom> rooms,
                                      const SurveyConfig& config, const Progress& progress = {});

}  // namespace enfilade
