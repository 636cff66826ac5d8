// RUN/leaks.json: where the building is not closed.
#pragma once

#include <string>
#include <vector>

#include "cells/rooms/leaks.hpp"

namespace enfilade {

/// {"leaks": [{"kind", "cell", "area_m2", "width_m", "path": [[x,y,z], ...]}, ...]}.
void write_leaks(const std::string& run_directory, const std::vector<Leak>& leaks);
/// Reads the leaks; none where the file is missing. Throws RunError where it is damaged.
std::vector<Leak> read_leaks(const std::string& run_directory);

}  // namespace enfilade
