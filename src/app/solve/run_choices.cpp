#include "app/solve/run_choices.hpp"

#include <fmt/format.h>

namespace enfilade {
namespace {

std::string word(const RunRecord& record, const char* key) {
  const auto* value = record.find(key);
  const auto* text = value != nullptr ? std::get_if<std::string>(value) : nullptr;
  return text != nullptr ? *text : "";
}

std::string bands(double solved, double of_scene) {
  if (solved < of_scene)
    return fmt::format("{} of {}: in the others every surface and light is as in one of these",
                       solved, of_scene);
  return solved == 1.0
             ? "1: the scene is grey"
             : fmt::format("{}: the scene's; links, rays and form factors are made once for all",
                           solved);
}

std::string basis(const std::string& name, bool is_asked) {
  if (is_asked) return name + ": as asked";
  return name + (name == "linear" ? ": it takes fewer links than constant at the same error"
                                  : ": of the run that was resumed");
}

std::string cells(double n) {
  return n > 1.0 ? fmt::format("{}: walls and doors tell which clusters may see each other", n)
                 : "1: no wall parts the scene, so any cluster may see any other";
}

std::string memory(const RunRecord& record) {
  const double budget = record.number("memory_bytes", 0.0);
  if (budget <= 0.0) return "no limit: every cluster stays in memory, files serve --resume alone";
  return record.number("peak_cluster_bytes", 0.0) < budget
             ? "within the budget: no cluster had to leave memory"
             : "the budget is full: clusters go to disk and come back";
}

std::string patches(const RunRecord& record) {
  if (record.number("estimated_patch_error", 0.0) <= record.number("target_error", 1.0))
    return "what is read off them is held to the asked error too";
  const double most = record.number("patch_links", 0.0);
  if (most <= 0.0 || record.number("links", 0.0) <= most)
    return "what is read off them is not as good as asked";
  return "what is read off them is not held to the asked error past --patch-links; a larger one, "
         "or 0, with --resume makes them finer";
}

std::string visibility(const RunRecord& record) {
  if (word(record, "visibility") == "rays") return "rays: as asked";
  return "exact: rays only behind many polygons, where little light is at stake, and to estimate "
         "errors";
}

}  // namespace

void describe_choices(RunRecord& record, bool basis_is_asked) {
  record.set("chosen_bands", RunRecord::Value(bands(record.number("solved_bands", 1.0),
                                                    record.number("bands", 1.0))));
  record.set("chosen_basis", RunRecord::Value(basis(word(record, "basis"), basis_is_asked)));
  record.set("chosen_cells", RunRecord::Value(cells(record.number("cells", 1.0))));
  record.set("chosen_memory", RunRecord::Value(memory(record)));
  record.set("chosen_patches", RunRecord::Value(patches(record)));
  record.set("chosen_visibility", RunRecord::Value(visibility(record)));
}

}  // namespace enfilade
