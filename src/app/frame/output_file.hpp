// Checks of the files that -o names, made before the work that fills them.
#pragma once

#include <string>

namespace enfilade {

/// Throws InputError where `path` cannot become a file: its directory does not exist or may not be
/// written, it is a directory itself, or one of the files that a RUN is computed from.
void check_output_file(const std::string& path);
/// The same for a scene file, whose name must end in .json.
void check_scene_output(const std::string& path);

}  // namespace enfilade
