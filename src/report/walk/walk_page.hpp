// walk.html: a solved building to walk through in a browser, with its light to read off.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "report/pictures/solved_scene.hpp"
#include "report/room_table/room_table.hpp"
#include "report/survey/room_cameras.hpp"
#include "report/walk/walk_arrays.hpp"

namespace enfilade {

struct WalkSubject {
  const SolvedScene& solved;
  std::string title;
  std::span<const SurveyRoom> rooms;
  std::span<const std::optional<RoomView>> views;  ///< of each room: where one stands in it
  /// Figures of the same rooms, in the same order; null where they have not been surveyed. Without
  /// them the table shows what the floors' patches have.
  const RoomTable* table = nullptr;
  WalkShares shares{};       ///< lamps that can be dimmed
  double patch_error = 0.0;  ///< relative error of what is read off patches, as estimated
};

/// Returns the page: one file that asks for no other and for no network. Its light is that of the
/// leaf patches, as 16-bit floating-point numbers: to 0.05%, and to 1e-9 of the brightest.
std::string walk_html(const WalkSubject& subject, const std::string& program);

/// Returns the program of the page, which the build has made with npm; none where it could not.
std::optional<std::string> walk_program();

}  // namespace enfilade
