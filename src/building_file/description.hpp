// Descriptions of buildings: JSON, with options of the command line put into it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "modeler/building.hpp"

namespace enfilade {

/// A number or a truth value that a description may give under `key`, and the command line as an
/// option.
struct DescriptionField {
  const char* key;
  const char* help;  ///< with the unit
  std::variant<int Building::*, double Building::*, bool Building::*> member;
  double low, high;  ///< both allowed
};
std::span<const DescriptionField> building_fields();

/// A key and its value as the command line spells it: a number, true, a word; wings as
/// "24,25:90,24" (bays, with a colon the degrees that they turn), furniture as "chair=300,bin=10"
/// (other kinds keep their number).
using BuildingOption = std::pair<std::string, std::string>;

/// Reads a description, format "enfilade-building", and puts the options in place of its values.
/// Throws InputError that names FILE and the key, or the option, for what is no building: unknown
/// keys, values out of range, wings that run into each other, furniture without a place.
Building describe_building(const std::string& text, const std::string& file,
                           std::span<const BuildingOption> options = {});

/// Returns the description of a preset; nothing where there is none of that name.
std::optional<std::string> preset_description(const std::string& name);
/// "demo, rr3425".
std::string preset_names();

}  // namespace enfilade
