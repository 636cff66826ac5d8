// Reading and writing scenes and probes.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace enfilade {

/// Reads an "enfilade-scene" JSON file (format in scenes/scene.schema.json). Throws InputError that
/// names the key (surfaces[12].reflectance[1]) or the line of a syntax error.
Scene read_scene(const std::string& path, Warnings& warnings);
/// Lengths are written in metres. Throws RunError where the file cannot be written.
void write_scene(const Scene& scene, const std::string& path);

/// The light at a probe, per band of the file.
struct ProbeAnswer {
  Spectrum irradiance;
  Spectrum error;  ///< one standard deviation
};

/// Reads {"probes": [{"p", "n"}, ...]}; a scene file with probes will do as well. Throws
/// InputError where the list is empty.
std::vector<Probe> read_probes(const std::string& path);
/// Writes the probes of `source_path` with "E" and "error" (per band) added to each, and "from" and
/// "unit" beside them. All other keys of that file are kept, but a scene's surfaces and lights;
/// "exitanceUnits", where it is there, becomes the unit's name.
void write_probe_answers(const std::string& source_path, const std::string& path,
                         const std::vector<ProbeAnswer>& answers, const std::string& from,
                         ExitanceUnit unit);

/// Writes `text` so that `path` holds either the old content or all of the new (temporary file,
/// then rename). Throws RunError where it cannot.
void write_file_atomically(const std::string& path, const std::string& text);

}  // namespace enfilade
