#include "parallel/prepare.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "scene/scene_io.hpp"
#include "store/graph_file.hpp"
#include "store/posix_file.hpp"

namespace enfilade {
namespace {

std::string text_of(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

/// What a RUN's content depends on beside the scene. The names are bound one by one, so that no new
/// option compiles unless it is put here too.
nlohmann::ordered_json options_of(const PrepareConfig& config) {
  const auto& [cells, sealed, clusters] = config;
  const auto& [min_occlusion, tolerance_relative, max_leaves] = cells;
  const auto& [walks, max_bounces, max_parts, min_length_relative, seed] = sealed;
  const auto& [max_polygons, max_extent_share, large_share, pool_polygons] = clusters;
  return {{"min_occlusion", min_occlusion},
          {"tolerance_relative", tolerance_relative},
          {"max_leaves", max_leaves},
          {"sealed_walks", walks},
          {"sealed_max_bounces", max_bounces},
          {"sealed_max_parts", max_parts},
          {"sealed_min_length_relative", min_length_relative},
          {"sealed_seed", seed},
          {"cluster_max_polygons", max_polygons},
          {"cluster_max_extent_share", max_extent_share},
          {"cluster_large_share", large_share},
          {"cluster_pool_polygons", pool_polygons}};
}

/// run.json: the mark that a RUN is prepared.
nlohmann::json read_mark(const std::string& run_directory) {
  std::ifstream in(run_directory + "/run.json");
  if (!in) return {};
  const nlohmann::json mark = nlohmann::json::parse(in, nullptr, false);
  const bool good = mark.is_object() && mark.value("format", "") == "enfilade-run" &&
                    mark.value("version", 0) == 1;
  return good ? mark : nlohmann::json{};
}

/// The scene's own file where it is one of ours (extra keys and all), else the scene as it was
/// imported.
void copy_scene(const Scene& scene, const std::string& path) {
  std::error_code code;
  if (std::filesystem::equivalent(scene.file, path, code)) return;
  const bool json = std::filesystem::path(scene.file).extension() == ".json";
  if (json && std::filesystem::exists(scene.file)) {
    replace_file(path, text_of(scene.file));
  } else {
    write_scene(scene, path);
  }
}

}  // namespace

Prepared prepare(const Scene& scene, const std::string& run_directory, const PrepareConfig& config,
                 Warnings& warnings, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  Prepared p;
  p.scene = scene;
  report_progress(progress, "pieces", 0.0);
  PieceReport report;
  const std::vector<Piece> pieces = make_pieces(p.scene, warnings, &report);
  p.covered_area_m2 = report.covered_area_m2;
  report_progress(progress, "cells", 0.1);
  p.cells = build_cells(pieces, config.cells);
  std::vector<CellPiece> cell_pieces;
  for (const Piece& piece : pieces) {
    const std::vector<CellPiece> parts = p.cells.cut(piece);
    cell_pieces.insert(cell_pieces.end(), parts.begin(), parts.end());
  }
  report_progress(progress, "clusters", 0.4);
  cell_pieces = cut_sealed_parts(p.scene, cell_pieces, p.cells.tolerance_m(), config.sealed);
  report_progress(progress, "clusters", 0.5);
  p.clusters = build_clusters(p.scene, cell_pieces, config.clusters);
  report_progress(progress, "visibility", 0.6);
  p.graph = visible_clusters(p.cells, p.clusters, progress);

  // Everything is computed before anything is written: a bad scene leaves no half-made RUN.
  make_directory(run_directory);
  std::filesystem::remove(run_directory + "/run.json");
  remove_directory(run_directory + "/common");
  remove_directory(run_directory + "/local");
  copy_scene(p.scene, run_directory + "/scene.json");
  replace_file(run_directory + "/cells.bin", to_bytes(p.cells));
  replace_file(run_directory + "/clusters.bin", to_bytes(std::span<const Cluster>(p.clusters)));
  write_graph(p.graph, run_directory + "/graph.txt");
  p.prepare_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const nlohmann::ordered_json mark = {
      {"format", "enfilade-run"},        {"version", 1},
      {"scene_hash", hex(p.scene.hash)}, {"options", options_of(config)},
      {"clusters", p.clusters.size()},   {"covered_area_m2", p.covered_area_m2},
      {"prepare_s", p.prepare_s}};
  replace_file(run_directory + "/run.json", mark.dump(1) + "\n");
  report_progress(progress, "visibility", 1.0);
  return p;
}

bool is_prepared(const std::string& run_directory, std::uint64_t scene_hash,
                 const PrepareConfig& config) {
  const nlohmann::json mark = read_mark(run_directory);
  if (mark.is_null() || mark.value("scene_hash", "") != hex(scene_hash)) return false;
  return mark.value("options", nlohmann::json()) == nlohmann::json(options_of(config));
}

Prepared load_prepared(const std::string& run_directory) {
  const nlohmann::json mark = read_mark(run_directory);
  if (mark.is_null()) {
    throw InputError(run_directory, "run.json", "not a prepared run",
                     "run 'enfilade prepare SCENE -o " + run_directory + "' first");
  }
  Prepared p;
  Warnings told_before;  // when the run was prepared
  p.scene = read_scene(run_directory + "/scene.json", told_before);
  p.scene.hash = std::stoull(mark.at("scene_hash").get<std::string>(), nullptr, 16);
  p.cells = complex_from_bytes(text_of(run_directory + "/cells.bin"));
  p.clusters = clusters_from_bytes(text_of(run_directory + "/clusters.bin"));
  p.graph = read_graph(run_directory + "/graph.txt");
  p.prepare_s = mark.value("prepare_s", 0.0);
  p.covered_area_m2 = mark.value("covered_area_m2", 0.0);
  return p;
}

Prepared prepare_on_root(Communicator& communicator, const std::string& scene_file,
                         const std::string& run_directory, const PrepareConfig& config,
                         Warnings& warnings, const Progress& progress) {
  std::optional<Prepared> prepared;
  communicator.on_root([&] {
    if (!scene_file.empty()) {
      const Scene scene = read_scene(scene_file, warnings);
      if (!is_prepared(run_directory, scene.hash, config)) {
        prepared = prepare(scene, run_directory, config, warnings, progress);
      }
    }
    if (!prepared) prepared = load_prepared(run_directory);
  });
  return prepared ? std::move(*prepared) : load_prepared(run_directory);
}

}  // namespace enfilade
