#include "app/run_description.hpp"

#include "base/hash_text.hpp"

namespace enfilade {

void describe_strategies(RunRecord& record, const SolveConfig& config) {
  record.set("version", ENFILADE_VERSION);
  record.set("revision", ENFILADE_REVISION);
  record.set("seed", config.seed);
  record.set("assignment", name_of(config.assignment));
  record.set("order", config.order == TourOrder::input ? "input" : "travelling-salesman");
  record.set("steal", config.steal);
  record.set("memory_bytes", config.memory_bytes);
}

void describe_run(RunRecord& record, const SolveConfig& config, const Prepared& prepared) {
  record.set("scene_hash", hash_text(prepared.scene.hash));
  record.set("unit", enfilade::name_of(prepared.scene.unit));
  record.set("target_error", config.target_error);
  describe_strategies(record, config);
}

}  // namespace enfilade
