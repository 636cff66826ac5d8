// Files of the source tree that tests read.
#pragma once

#include <string>

namespace enfilade {

/// Returns the path of a file that is named from the project's root: "scenes/duplex.json".
std::string source_file(const std::string& name);

}  // namespace enfilade
