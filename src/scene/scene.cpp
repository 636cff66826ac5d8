#include "scene/scene.hpp"

namespace enfilade {

const char* name_of(ExitanceUnit unit) {
  return unit == ExitanceUnit::watt_per_m2 ? "W/m2" : "lm/m2";
}

const char* irradiance_label(ExitanceUnit unit) {
  return unit == ExitanceUnit::watt_per_m2 ? "W/m2" : "lx";
}

}  // namespace enfilade
