// Options of the command line, put into the description of a building.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "modeler/building.hpp"

namespace enfilade {

/// Writes the value of one option into the document. Throws InputError for what cannot be read.
void put_option(nlohmann::json& document, const Building& building, const std::string& key,
                const std::string& value);

}  // namespace enfilade
