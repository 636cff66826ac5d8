// Reading and writing scenes and probes.
#pragma once

#include <string>
#include <utility>
#include <vector>

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
  /// Irradiance over that of an unobstructed horizontal plane, percent; empty where not asked for.
  Spectrum daylight_factor{};
  /// The irradiance by each share of the light, with its name; empty where none was asked for.
  std::vector<std::pair<std::string, Spectrum>> shares{};
};

/// What a probe file holds that is a table (CSV).
struct ProbeTable {
  char separator = ',';                        ///< between fields: a comma, a semicolon or a tab
  bool decimal_comma = false;                  ///< in its numbers
  std::vector<std::string> columns;            ///< names; made up where the file has no header
  std::string header;                          ///< the line of the names
  std::vector<std::string> lines;              ///< of each probe, as they stand in the file
  std::vector<std::vector<std::string>> rows;  ///< their fields
};

/// A probe file: its text, read once, and its probes.
struct ProbeFile {
  std::string path, text;
  std::vector<Probe> probes;
  ProbeTable table = {};  ///< without columns where the file is JSON
};

/// Reads {"probes": [{"p", "n"}, ...]}, a scene file with probes, or, where the name ends in .csv,
/// a table with the columns x, y, z and perhaps nx, ny, nz (else the normal points up), in metres,
/// with or without a header; without one the columns stand in this order. Where semicolons or tabs
/// separate its fields, numbers may have decimal commas. Throws InputError that names the key, or
/// line and column, and where there are no probes.
ProbeFile read_probes(const std::string& path);
/// Writes the probes of `source` with their answers, as a table where `path` ends in .csv, else as
/// JSON.
/// JSON: "E", "error" and perhaps "daylight_factor" (per band) are added to each probe, with the
/// shares as "shares": {NAME: per band}, and "from" and "unit" beside them. All other keys of the
/// source's text are kept, but a scene's surfaces and lights; "exitanceUnits", where it is there,
/// becomes the unit's name. A table's other columns become keys. Table: the source's columns as
/// they are (of a JSON source x, y, z, nx, ny, nz and name), then E and error (E_0, E_1, ...,
/// error_0, ... of several bands), the daylight factor, unit and from, then "E by NAME".
void write_probe_answers(const ProbeFile& source, const std::string& path,
                         const std::vector<ProbeAnswer>& answers, const std::string& from,
                         ExitanceUnit unit);

}  // namespace enfilade
