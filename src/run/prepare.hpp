// A prepared scene in a RUN directory: made, kept and loaded again, on one rank.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "preparation/preparation.hpp"
#include "run/run_lock.hpp"

namespace enfilade {

/// Makes RUN/ (scene.json, cells, clusters, graph, leaks; run.json last, which marks RUN as
/// complete) and removes a solution that RUN held. Throws InputError, and writes nothing, where the
/// scene is bad or the directory holds files and has no mark of enfilade. `warnings` are those of
/// reading the scene; the warnings of the preparation are added.
/// `lock` gets RUN locked to write.
Prepared prepare(const Scene& scene, const std::string& run_directory, const PrepareConfig& config,
                 Warnings& warnings, const Progress& progress, RunLock& lock);
Prepared prepare(const Scene& scene, const std::string& run_directory, const PrepareConfig& config,
                 Warnings& warnings);
/// Finds G_cluster for a prepared RUN that has none, and keeps it there.
void keep_visibility(Prepared& prepared, const std::string& run_directory,
                     const PrepareConfig& config, const Progress& progress = {});
/// Throws InputError where RUN is not a prepared run.
Prepared load_prepared(const std::string& run_directory);
/// Returns the scene file as RUN keeps it. Throws as load_prepared().
std::string scene_text(const std::string& run_directory);
/// Prepares RUN as `from` is prepared, for a scene of the same geometry with other lamps or
/// reflectances. Where both are one directory, its solution moves to RUN/before-relight; else a
/// solution that RUN held is removed. `lock` gets RUN locked to write. Throws InputError as
/// prepare(), before anything is written.
void prepare_relit(const Scene& scene, const std::string& from, const std::string& run_directory,
                   RunLock& lock);
/// True where `run_directory` is prepared for the scene with this hash, and with this
/// configuration.
bool is_prepared(const std::string& run_directory, std::uint64_t scene_hash,
                 const PrepareConfig& config);

/// Reads a scene, wherever it comes from, and its warnings.
using SceneSource = std::function<Scene(Warnings&)>;

/// Reads the scene and prepares RUN for it; where RUN is prepared for it already, with this
/// configuration or with the same one and more (G_cluster, proofs of hidden pairs), RUN is loaded
/// as it is. `read` may be empty: RUN must be prepared then. With `resume`, a RUN that has a
/// solution of another scene is refused (InputError), not prepared anew. The scene's warnings are
/// in the result. `lock` gets RUN locked to write, before anything is read from it.
Prepared prepare_or_load(const SceneSource& read, const std::string& run_directory,
                         const PrepareConfig& config, const Progress& progress, bool resume,
                         RunLock& lock);

}  // namespace enfilade
