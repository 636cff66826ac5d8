// Files that -o names are looked at before the work that fills them.
#pragma once

#include <string>

namespace enfilade {

/// Throws InputError where `path` cannot become a file: its directory does not exist or may not be
/// written, or it is a directory itself.
void check_output_file(const std::string& path);

}  // namespace enfilade
