#include "run/prepare.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/memory_wanted.hpp"
#include "base/posix_file.hpp"
#include "light_survey/light_survey.hpp"
#include "run/leak_file.hpp"
#include "run/run_mark.hpp"
#include "run/sections/run_layout.hpp"
#include "scene/equal_bands.hpp"
#include "scene/make_lights.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {
namespace {

/// What a RUN's content depends on beside the scene. The names are bound one by one, so that no new
/// option compiles unless it is put here too.
std::string options_of(PrepareConfig config) {
  if (!config.cluster_graph) config.visibility = {};  // it decides nothing then
  const auto& [cells, unreachable, clusters, contacts, cluster_graph, visibility] = config;
  const auto& [min_occlusion, min_border_share, tolerance_relative, max_leaves] = cells;
  const auto& [walks, max_bounces, max_parts, free_steps, steps_per_piece, min_length_relative,
               seed] = unreachable;
  const auto& [max_polygons, max_extent_share, large_share, pool_polygons] = clusters;
  const auto& [min_contact_relative, most_contacts] = contacts;
  const auto& [max_passes, prove_hidden, occlusion] = visibility;
  const auto& [first_rays, rays, max_pair_parts, max_depth, min_pair_parts, all_pair_parts,
               window_rays, window_parts, window_planes, window_path, max_planes, most_open,
               max_pieces, pair_seed] = occlusion;
  const nlohmann::ordered_json json = {{"min_occlusion", min_occlusion},
                                       {"min_border_share", min_border_share},
                                       {"tolerance_relative", tolerance_relative},
                                       {"max_leaves", max_leaves},
                                       {"unreachable_walks", walks},
                                       {"unreachable_max_bounces", max_bounces},
                                       {"unreachable_max_parts", max_parts},
                                       {"unreachable_free_steps", free_steps},
                                       {"unreachable_steps_per_piece", steps_per_piece},
                                       {"unreachable_min_length_relative", min_length_relative},
                                       {"unreachable_seed", seed},
                                       {"cluster_max_polygons", max_polygons},
                                       {"cluster_max_extent_share", max_extent_share},
                                       {"cluster_large_share", large_share},
                                       {"cluster_pool_polygons", pool_polygons},
                                       {"contact_min_length_relative", min_contact_relative},
                                       {"contact_most", most_contacts},
                                       {"cluster_graph", cluster_graph},
                                       {"visibility_max_passes", max_passes},
                                       {"visibility_prove_hidden", prove_hidden},
                                       {"occlusion_first_rays", first_rays},
                                       {"occlusion_rays", rays},
                                       {"occlusion_max_parts", max_pair_parts},
                                       {"occlusion_max_depth", max_depth},
                                       {"occlusion_min_parts", min_pair_parts},
                                       {"occlusion_all_parts", all_pair_parts},
                                       {"occlusion_window_rays", window_rays},
                                       {"occlusion_window_parts", window_parts},
                                       {"occlusion_window_planes", window_planes},
                                       {"occlusion_window_path", window_path},
                                       {"occlusion_max_planes", max_planes},
                                       {"occlusion_most_open", most_open},
                                       {"occlusion_max_pieces", max_pieces},
                                       {"occlusion_seed", pair_seed}};
  return json.dump();
}

/// The scene's own text where it is one of ours (extra keys and all), else the scene as imported.
void keep_scene(const Scene& scene, const std::string& run_directory, RunMark& mark) {
  constexpr const char* name = "scene.json";
  const std::string path = run_directory + "/" + name;
  if (scene.text.empty()) {
    write_scene(scene, path);
    mark.files[name] = checksum(read_file(path));
  } else {
    keep_prepared_file(run_directory, name, scene.text, mark);
  }
}

/// `from_bytes` of a file of the preparation. Throws RunError with the file's name.
template <class FromBytes>
auto load(const std::string& run_directory, const char* name, const RunMark& mark,
          FromBytes from_bytes) {
  const std::string bytes = read_prepared_file(run_directory, name, mark);
  try {
    return from_bytes(std::string_view(bytes));
  } catch (const RunError& error) {
    throw RunError(run_directory + "/" + name + ": is damaged (" + error.what() +
                   "); prepare the run again");
  }
}

/// A run that is to be resumed is not prepared anew: that would remove its solution.
void refuse_to_drop(const std::string& run_directory) {
  std::error_code code;
  if (!std::filesystem::exists(RunLayout(run_directory).manifest(), code)) return;
  throw InputError(run_directory, "--resume",
                   "the solution there is of another scene, or prepared otherwise",
                   "solve without --resume, or into another directory");
}

}  // namespace

Prepared prepare(const Scene& scene, const std::string& run_directory, const PrepareConfig& config,
                 Warnings& warnings) {
  RunLock lock;
  return prepare(scene, run_directory, config, warnings, {}, lock);
}

Prepared prepare(const Scene& scene, const std::string& run_directory, const PrepareConfig& config,
                 Warnings& warnings, const Progress& progress, RunLock& lock) {
  const auto start = std::chrono::steady_clock::now();
  const MemoryPurpose purpose("the preparation of the scene");
  check_run_directory(run_directory);
  if (read_run_mark(run_directory)) lock.write(run_directory);
  std::vector<Leak> leaks;
  Prepared p = prepare_scene(scene, config, warnings, leaks, progress);
  // Everything is computed before anything is written: a bad scene leaves no half-made RUN.
  claim_run_directory(run_directory, lock);
  remove_directory(run_directory + "/common");
  remove_directory(run_directory + "/local");
  remove_directory(run_directory + "/costs");
  RunMark mark;
  keep_scene(scene, run_directory, mark);
  keep_prepared_file(run_directory, "cells.bin", to_bytes(p.cells), mark);
  keep_prepared_file(run_directory, "clusters.bin", to_bytes(std::span<const Cluster>(p.clusters)),
                     mark);
  write_leaks(run_directory, leaks, mark);
  keep_prepared_file(run_directory, "graph.bin", to_bytes(p.graph), mark);
  p.prepare_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  mark.prepared = true;
  mark.scene_hash = p.scene.hash;
  mark.options = options_of(config);
  mark.has_visibility = p.has_visibility;
  mark.covered_area_m2 = p.covered_area_m2;
  mark.prepare_s = p.prepare_s;
  mark.steps = p.steps;
  mark.warnings = p.warnings;
  write_run_mark(run_directory, mark);
  p.preparation = mark.preparation();
  report_progress(progress, "visibility", 1.0);
  return p;
}

bool is_prepared(const std::string& run_directory, std::uint64_t scene_hash,
                 const PrepareConfig& config) {
  const auto mark = read_run_mark(run_directory);
  return mark && mark->prepared && mark->scene_hash == scene_hash &&
         mark->options == options_of(config);
}

namespace {

RunMark mark_of_prepared(const std::string& run_directory) {
  const auto mark = read_run_mark(run_directory);
  // A run that was left or damaged has its scene.
  if (mark && !mark->prepared && std::filesystem::exists(run_directory + "/history.json") &&
      !std::filesystem::exists(run_directory + "/scene.json")) {
    throw InputError(run_directory, "run.json", "a replay: it holds figures alone, and no light",
                     "name the run that was replayed; stats.json says which");
  }
  if (!mark || !mark->prepared) {
    const std::string fault = mark ? mark->fault : "", other = "of another version of enfilade";
    throw InputError(run_directory, "run.json",
                     fault.empty()                            ? "not a prepared run"
                     : fault.find(other) != std::string::npos ? other
                                                              : "damaged",
                     "run 'enfilade prepare SCENE -o " + run_directory + "' first");
  }
  return *mark;
}

/// The clusters as they are kept, without what walks to the old lamps found.
std::string without_walks(const std::string& bytes) {
  std::vector<Cluster> clusters = clusters_from_bytes(bytes);
  for (Cluster& cluster : clusters)
    for (ClusterPolygon& polygon : cluster.polygons) polygon.walked_dark = false;
  return to_bytes(clusters);
}

}  // namespace

void prepare_relit(const Scene& scene, const std::string& from, const std::string& run_directory,
                   RunLock& lock) {
  RunMark mark = mark_of_prepared(from);
  std::map<std::string, std::string> kept;
  for (const auto& [name, sum] : mark.files)
    if (name != "scene.json") kept[name] = read_prepared_file(from, name, mark);
  kept.at("clusters.bin") = without_walks(kept.at("clusters.bin"));
  std::error_code missing;
  const bool in_place = std::filesystem::equivalent(from, run_directory, missing);
  check_run_directory(run_directory);
  claim_run_directory(run_directory, lock);
  const std::string before = run_directory + "/before-relight";
  remove_directory(before);
  if (in_place) {
    make_directory(before);
    move_file(run_directory + "/common", before + "/common");
  }
  for (const char* name : {"/common", "/local", "/costs"}) remove_directory(run_directory + name);
  mark.files.clear();
  keep_scene(scene, run_directory, mark);
  for (const auto& [name, bytes] : kept) keep_prepared_file(run_directory, name, bytes, mark);
  mark.scene_hash = scene.hash;
  write_run_mark(run_directory, mark);
}

std::string scene_text(const std::string& run_directory) {
  return read_prepared_file(run_directory, "scene.json", mark_of_prepared(run_directory));
}

Prepared load_prepared(const std::string& run_directory) {
  const RunMark mark = mark_of_prepared(run_directory);
  Prepared p;
  Warnings told_before;  // when the run was prepared
  p.scene = scene_from(read_prepared_file(run_directory, "scene.json", mark),
                       run_directory + "/scene.json", told_before);
  p.scene.text = {};
  make_lights(p.scene);
  survey_far_lights(p.scene);
  merge_equal_bands(p.scene);
  p.scene.hash = mark.scene_hash;
  p.preparation = mark.preparation();
  p.cells = load(run_directory, "cells.bin", mark, complex_from_bytes);
  p.clusters = load(run_directory, "clusters.bin", mark, clusters_from_bytes);
  p.graph = load(run_directory, "graph.bin", mark, graph_from_bytes);
  if (p.graph.size() != p.clusters.size()) {
    throw RunError(run_directory + "/graph.bin: is of other clusters; prepare the run again");
  }
  p.has_visibility = mark.has_visibility;
  p.prepare_s = mark.prepare_s;
  p.steps = mark.steps;
  p.covered_area_m2 = mark.covered_area_m2;
  p.warnings = mark.warnings;
  return p;
}

namespace {

/// A RUN with G_cluster serves where none was asked for, and one whose hidden pairs were proved
/// where no proof was asked for.
bool serves(const std::string& run_directory, std::uint64_t scene_hash, PrepareConfig config) {
  if (is_prepared(run_directory, scene_hash, config)) return true;
  if (!config.cluster_graph) {
    config.cluster_graph = true;
    return serves(run_directory, scene_hash, config);
  }
  if (config.visibility.prove_hidden) return false;
  config.visibility.prove_hidden = true;
  return is_prepared(run_directory, scene_hash, config);
}

}  // namespace

void keep_visibility(Prepared& prepared, const std::string& run_directory,
                     const PrepareConfig& config, const Progress& progress) {
  if (prepared.has_visibility) return;
  find_visibility(prepared, config.visibility, progress);
  std::optional<RunMark> mark = read_run_mark(run_directory);
  if (!mark || !mark->prepared) return;
  PrepareConfig with_graph = config;
  with_graph.cluster_graph = true;
  mark->options = options_of(with_graph);
  mark->has_visibility = true;
  // Between the two files the mark would not tell which graph there is.
  RunMark unfinished = *mark;
  unfinished.prepared = false;
  write_run_mark(run_directory, unfinished);
  keep_prepared_file(run_directory, "graph.bin", to_bytes(prepared.graph), *mark);
  write_run_mark(run_directory, *mark);
}

Prepared prepare_or_load(const SceneSource& read, const std::string& run_directory,
                         const PrepareConfig& config, const Progress& progress, bool resume,
                         RunLock& lock) {
  if (read_run_mark(run_directory)) lock.write(run_directory);
  if (read) {
    Warnings found;
    const Scene scene = read(found);
    PrepareConfig less = config;
    less.cluster_graph = false;
    if (!serves(run_directory, scene.hash, config) &&
        !is_prepared(run_directory, scene.hash, less)) {
      if (resume) refuse_to_drop(run_directory);
      return prepare(scene, run_directory, config, found, progress, lock);
    }
  }
  Prepared prepared = load_prepared(run_directory);
  if (config.cluster_graph) keep_visibility(prepared, run_directory, config, progress);
  return prepared;
}

}  // namespace enfilade
