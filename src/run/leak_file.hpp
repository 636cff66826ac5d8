// RUN/leaks.json: where the building is not closed.
#pragma once

#include <string>
#include <vector>

#include "cells/rooms/leaks.hpp"
#include "run/run_mark.hpp"

namespace enfilade {

/// {"leaks": [{"kind", "cell", "area_m2", "width_m", "path": [[x,y,z], ...]}, ...]}.
/// The mark gets its checksum.
void write_leaks(const std::string& run_directory, const std::vector<Leak>& leaks, RunMark& mark);
/// Reads the leaks of a prepared RUN. Throws RunError where the file is damaged.
std::vector<Leak> read_leaks(const std::string& run_directory);

}  // namespace enfilade
