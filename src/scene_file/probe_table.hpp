// Probes as a table (CSV).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene_file/scene_io.hpp"

namespace enfilade {

/// True for a name that ends in .csv.
bool is_table(const std::string& path);

/// Fills probes and table of a file from its text. Throws InputError with line, column and remedy.
ProbeFile read_probe_table(ProbeFile file);

/// Returns the file with its answers as a table (see write_probe_answers()).
std::string probe_table(const ProbeFile& source, const std::vector<ProbeAnswer>& answers,
                        const std::string& from, const std::string& unit);

/// Returns a table's probes as a document, each with the table's other columns as keys.
nlohmann::ordered_json json_of_table(const ProbeFile& source);

}  // namespace enfilade
