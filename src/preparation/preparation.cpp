#include "preparation/preparation.hpp"

#include <chrono>

#include "base/peak_memory.hpp"
#include "light_survey/light_survey.hpp"
#include "preparation/leak_warnings.hpp"
#include "scene/equal_bands.hpp"
#include "scene/make_lights.hpp"

namespace enfilade {
namespace {

using Clock = std::chrono::steady_clock;

/// Writes down what each step takes.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<PrepareStep>& steps) : steps_(steps) {}
  void end_of(const char* step) {
    const auto now = Clock::now();
    steps_.push_back({step, std::chrono::duration<double>(now - start_).count(), peak_rss_bytes()});
    start_ = now;
  }

 private:
  std::vector<PrepareStep>& steps_;
  Clock::time_point start_ = Clock::now();
};

/// The pieces, each cut into the parts that lie in one cell.
std::vector<CellPiece> pieces_by_cell(std::span<const Piece> pieces, const CellComplex& cells) {
  std::vector<CellPiece> all;
  for (const Piece& piece : pieces) {
    const std::vector<CellPiece> parts = cells.cut(piece);
    all.insert(all.end(), parts.begin(), parts.end());
  }
  return all;
}

/// The walls: light passes through panes, so that they part no cells. All pieces where all are
/// panes.
std::vector<Piece> opaque_pieces(std::span<const Piece> pieces, const Scene& scene) {
  std::vector<Piece> walls;
  for (const Piece& piece : pieces) {
    if (!scene.surfaces[piece.surface.index()].is_pane()) walls.push_back(piece);
  }
  return walls.empty() ? std::vector<Piece>(pieces.begin(), pieces.end()) : walls;
}

}  // namespace

void find_visibility(Prepared& prepared, const VisibilityConfig& config, const Progress& progress) {
  if (prepared.has_visibility) return;
  report_progress(progress, "visibility", 0.6);
  prepared.graph = visible_clusters(prepared.cells, prepared.clusters, progress, config);
  prepared.has_visibility = true;
}

Prepared prepare_scene(const Scene& scene, const PrepareConfig& config, Warnings& warnings,
                       std::vector<Leak>& leaks, const Progress& progress) {
  const auto start = Clock::now();
  Prepared p;
  p.scene = scene;
  p.scene.text = {};
  Stopwatch stopwatch(p.steps);
  report_progress(progress, "pieces", 0.0);
  PieceReport report;
  const std::vector<Piece> pieces = make_pieces(p.scene, warnings, &report);
  p.covered_area_m2 = report.covered_area_m2;
  make_lights(p.scene);
  survey_far_lights(p.scene);
  survey_light(p.scene, warnings);
  stopwatch.end_of("pieces");
  report_progress(progress, "cells", 0.1);
  p.cells = build_cells(opaque_pieces(pieces, p.scene), config.cells, leaks);
  warn_of_leaks(leaks, warnings);
  std::vector<CellPiece> cell_pieces = pieces_by_cell(pieces, p.cells);
  stopwatch.end_of("cells");
  report_progress(progress, "clusters", 0.4);
  cell_pieces =
      cut_unreachable_parts(p.scene, cell_pieces, p.cells.tolerance_m(), config.unreachable);
  report_progress(progress, "clusters", 0.5);
  p.clusters = build_clusters(p.scene, cell_pieces, config.clusters, dominant_frame(pieces));
  find_contacts(p.clusters, p.cells.tolerance_m(), config.contacts);
  merge_equal_bands(p.scene);
  set_panes(p.clusters, p.scene);
  stopwatch.end_of("clusters");
  p.has_visibility = false;
  if (config.cluster_graph) {
    find_visibility(p, config.visibility, progress);
  } else {
    p.graph = neighbour_graph(BuildingTree(p.clusters));
  }
  stopwatch.end_of("visibility");
  p.prepare_s = std::chrono::duration<double>(Clock::now() - start).count();
  p.warnings = warnings;
  return p;
}

}  // namespace enfilade
