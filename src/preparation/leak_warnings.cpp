#include "preparation/leak_warnings.hpp"

#include <cstdio>
#include <string>

namespace enfilade {
namespace {

const char* what_of(LeakKind kind) {
  switch (kind) {
    case LeakKind::gap:
      return "light leaks out through a gap, path in leaks.json; close it if that is not meant";
    case LeakKind::open_side:
      return "a room is open to the outside as if a wall was missing, path in leaks.json; add the "
             "wall if there is one";
    case LeakKind::lost_room:
      break;
  }
  return "a room is so open that it is taken as outside, path in leaks.json; close its walls if it "
         "is a room";
}

/// Where the opening is, or the room.
std::string place_of(const Leak& leak) {
  const Vec3& p = leak.path.front();
  char text[160];
  if (leak.kind == LeakKind::lost_room) {
    std::snprintf(text, sizeof text, "at (%.10g, %.10g, %.10g)", p.x, p.y, p.z);
  } else {
    std::snprintf(text, sizeof text, "cell %u around (%.10g, %.10g, %.10g), %.3g m2, %.3g m wide",
                  leak.cell.value, p.x, p.y, p.z, leak.area_m2, leak.width_m);
  }
  return text;
}

}  // namespace

void warn_of_leaks(const std::vector<Leak>& leaks, Warnings& warnings) {
  for (const Leak& leak : leaks) warnings.add(place_of(leak), what_of(leak.kind));
}

}  // namespace enfilade
