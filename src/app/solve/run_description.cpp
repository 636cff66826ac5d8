#include "app/solve/run_description.hpp"

#include "app/solve/revision.hpp"
#include "base/hash_text.hpp"

namespace enfilade {

void describe_strategies(RunRecord& record, const SolveConfig& config) {
  record.set("version", ENFILADE_VERSION);
  record.set("revision", ENFILADE_REVISION);
  record.set("seed", config.seed);
  record.set("scheme", name_of(config.scheme));
  record.set("assignment", name_of(config.assignment));
  record.set("order", name_of(config.order));
  record.set("iteration", config.method.jacobi ? "jacobi" : "hybrid");
  record.set("hierarchy", name_of(config.topmost()));
  record.set("steal", config.steal);
  record.set("memory_manager", name_of(config.memory_manager));
  record.set("memory_bytes", config.memory_bytes);
}

void describe_run(RunRecord& record, const SolveConfig& config, const Prepared& prepared) {
  record.set("scene_hash", hash_text(prepared.scene.hash));
  record.set("unit", enfilade::name_of(prepared.scene.unit));
  record.set("target_error", config.target_error);
  if (!config.gather.target_points.empty())
    record.set("target_points", config.gather.target_points.size());
  record.set("patch_links", config.most_patch_links());
  record.set("coarse_correction", config.method.coarse_correction);
  describe_strategies(record, config);
}

}  // namespace enfilade
