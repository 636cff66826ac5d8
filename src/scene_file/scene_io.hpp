// Reading and writing scenes and probes.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace enfilade {

/// Reads an "enfilade-scene" JSON file (format in scenes/scene.schema.json). Throws InputError that
/// names the key (surfaces[12].reflectance[1]) or the line of a syntax error. Photometric files
/// that it names must lie in its folder or below, unless `allow_outside`; Scene::text holds them
/// then.
Scene read_scene(const std::string& path, Warnings& warnings, bool allow_outside = false);
/// The same of the text of the file at `path`.
Scene scene_from(std::string text, const std::string& path, Warnings& warnings);
/// Lengths are written in metres. Throws RunError where the file cannot be written.
void write_scene(const Scene& scene, const std::string& path);

/// The light at a probe, per band of the file.
struct ProbeAnswer {
  Spectrum irradiance;
  Spectrum error;  ///< one standard deviation
};

/// A probe file: its text, read once, and its probes.
struct ProbeFile {
  std::string path, text;
  std::vector<Probe> probes;
};

/// Reads {"probes": [{"p", "n"}, ...]}; a scene file with probes will do as well. Throws
/// InputError where the list is empty.
ProbeFile read_probes(const std::string& path);
/// Writes the probes of `source` with "E" and "error" (per band) added to each, and "from" and
/// "unit" beside them. All other keys of its text are kept, but a scene's surfaces and lights;
/// "exitanceUnits", where it is there, becomes the unit's name.
void write_probe_answers(const ProbeFile& source, const std::string& path,
                         const std::vector<ProbeAnswer>& answers, const std::string& from,
                         ExitanceUnit unit);

}  // namespace enfilade
