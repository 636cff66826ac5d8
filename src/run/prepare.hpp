// A prepared scene in a RUN directory: made, kept and loaded again. One rank's work.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "preparation/preparation.hpp"

namespace enfilade {

/// Makes RUN/ (scene.json, cells, clusters, graph; run.json last, which says that all is there) and
/// drops whatever solution it held. Nothing is written where the scene is bad, nor into a directory
/// that holds files of somebody else: InputError. `warnings` are those of reading the scene; what
/// comes up here is added.
Prepared prepare(const Scene& scene, const std::string& run_directory, const PrepareConfig& config,
                 Warnings& warnings, const Progress& progress = {});
/// Throws InputError where RUN is not a prepared run.
Prepared load_prepared(const std::string& run_directory);
/// True where `run_directory` is prepared for the scene with this hash, and with this
/// configuration.
bool is_prepared(const std::string& run_directory, std::uint64_t scene_hash,
                 const PrepareConfig& config);

/// Reads a scene, wherever it comes from, and its warnings.
using SceneSource = std::function<Scene(Warnings&)>;

/// Reads the scene and prepares RUN for it; where RUN is prepared for it already, with this
/// configuration or with proofs of what is hidden besides, that is kept and loaded. `read` may be
/// empty: RUN must be prepared then. With `resume`, a RUN that has a solution of another
/// scene is refused (InputError), not prepared anew. The scene's warnings are in the result.
Prepared prepare_or_load(const SceneSource& read, const std::string& run_directory,
                         const PrepareConfig& config, const Progress& progress = {},
                         bool resume = false);

}  // namespace enfilade
