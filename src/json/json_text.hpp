// JSON files, read so that every fault names its file, line and key.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "json/input_file.hpp"

namespace enfilade {

/// Parses `text` of file `path`, or throws InputError with line and column, also where lists and
/// objects lie in each other more than 100 deep. NaN, Infinity and
/// numbers too large for a double become strings of the same spelling, so that whoever reads the
/// value can refuse it by its key.
nlohmann::ordered_json parse_ordered_json(const std::string& text, const std::string& path);
nlohmann::json parse_json(const std::string& text, const std::string& path);

/// Returns a value as a message shows it: short, on one line.
std::string shown(const nlohmann::json& value);
/// Returns a name in quotes, on one line.
std::string in_quotes(const std::string& name);

}  // namespace enfilade
