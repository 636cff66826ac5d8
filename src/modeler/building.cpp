#include "modeler/building.hpp"

#include <algorithm>

namespace enfilade {

const char* name_of(FurnitureKind kind) {
  constexpr std::array<const char*, furniture_kinds> names{
      "lamp", "desk",  "chair",   "table",     "shelf",  "cupboard",
      "bin",  "plant", "monitor", "desk_lamp", "picture"};
  return names[index_of(kind)];
}

int Building::bays() const {
  int sum = 0;
  for (const Wing& wing : wings) sum += wing.bays;
  return sum;
}

InputError Building::fault(const std::string& key, const std::string& what,
                           const std::string& hint) const {
  const std::string root = key.substr(0, key.find_first_of(".["));
  if (std::find(option_keys.begin(), option_keys.end(), root) == option_keys.end()) {
    return {file, key, what, hint};
  }
  std::string option = root;
  std::replace(option.begin(), option.end(), '_', '-');
  return {"command line", "--" + option, (key == root ? "" : key + " ") + what, hint};
}

}  // namespace enfilade
