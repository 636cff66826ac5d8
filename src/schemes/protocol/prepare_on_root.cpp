#include "schemes/protocol/prepare_on_root.hpp"

#include <optional>

namespace enfilade {

Prepared prepare_on_root(Communicator& communicator, const SceneSource& read,
                         const std::string& run_directory, const PrepareConfig& config,
                         Warnings& warnings, const Progress& progress, bool resume, RunLock& lock) {
  std::optional<Prepared> prepared;
  communicator.on_root(
      [&] { prepared = prepare_or_load(read, run_directory, config, progress, resume, lock); });
  lock.join(run_directory);
  if (!prepared) prepared = load_prepared(run_directory);
  warnings = prepared->warnings;
  return std::move(*prepared);
}

}  // namespace enfilade
