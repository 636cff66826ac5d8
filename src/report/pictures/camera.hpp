// Cameras: those of a file, or automatic ones, whose places are found from the scene.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/pictures/solved_scene.hpp"

namespace enfilade {

struct Camera {
  std::string name;   ///< "room-1"
  std::string title;  ///< what it shows, for captions; may be empty
  Vec3 eye{0.0}, look_at{0.0, 1.0, 0.0}, up{0.0, 0.0, 1.0};
  double vertical_angle_deg = 60.0;
  double parallel_height_m = 0.0;  ///< > 0: parallel projection, this high
  /// Cut-away: surfaces above this height, facades and backs are left out.
  std::optional<double> cut_above_m;
};

struct AutoCameraConfig {
  int inside = 3;  ///< most views from within rooms
  double eye_height_m = 1.6;
  bool cut_away = true;  ///< and a view into each storey from above
  int most_storeys = 4;
  double aspect = 16.0 / 9.0;  ///< width over height of the pictures, for cut-aways to fit
};

/// Returns views from within the largest lit rooms, at eye height, along the longest view, each in
/// another room, "room-1", "room-2"...; then the cut-aways "storey-1", "storey-2"... Deterministic.
std::vector<Camera> automatic_cameras(const SolvedScene& solved,
                                      const AutoCameraConfig& config = {});

/// {"cameras": [{"name", "eye": [x,y,z], "look_at": [x,y,z], "up": [x,y,z], "vertical_angle_deg",
/// "parallel_height_m", "cut_above_m"}]}; all but eye and look_at may be missing. Throws
/// InputError.
std::vector<Camera> read_cameras(const std::string& path);

/// Makes `up` a unit vector. Throws InputError where a number of the camera is outside the limits
/// (base/limits.hpp), with `where` before the number's name.
void check_camera(Camera& camera, const std::string& file, const std::string& where);

}  // namespace enfilade
