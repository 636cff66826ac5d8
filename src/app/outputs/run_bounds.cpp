#include "app/outputs/run_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>

#include "base/safe_text.hpp"
#include "scene/equal_bands.hpp"

namespace enfilade {
namespace {

/// Rounding of the arithmetic, relative: bounds are widened by it.
constexpr double rounding = 1e-9;

/// A line of the table: a set of polygons, and what is known of its mean irradiance.
struct Line {
  std::string kind{}, name{}, place{}, group{};
  double area_m2 = 0.0;
  std::vector<double> lower{}, upper{}, estimate{};  ///< per band that is solved
};

/// Mean irradiance of each polygon as the run has it: [polygon][band].
std::vector<std::vector<double>> estimates(const Scene& scene,
                                           const std::vector<ClusterState>& solution) {
  std::vector<std::vector<double>> found;
  for (const ClusterState& state : solution) {
    const PatchForest& forest = state.patches();
    const auto terms = static_cast<std::size_t>(forest.terms());
    for (std::size_t k = 0; k < forest.polygons(); ++k) {
      std::vector<double>& of_bands = found.emplace_back();
      // The first term is the value at the centroid, which is the mean of an affine function.
      for (std::size_t band = 0; band < static_cast<std::size_t>(scene.bands); ++band)
        of_bands.push_back(forest.irradiance(k)[band * terms]);
    }
  }
  return found;
}

class TableMaker {
 public:
  TableMaker(const Prepared& prepared, const BoundedRun& run, const BoundResult& bounds,
             const std::vector<ClusterState>& solution)
      : scene_(prepared.scene), bounds_(bounds), estimate_(estimates(prepared.scene, solution)) {
    for (const BoundPolygon& p : run.scene.polygons) areas_m2_.push_back(area_m2(p.polygon));
  }

  /// Fills a line's area and estimate, and its bounds by the polygons' unless `known` has better.
  void fill(Line& line, const std::vector<std::uint32_t>& polygons,
            const std::vector<Range>* known) const {
    const auto bands = static_cast<std::size_t>(scene_.bands);
    for (std::vector<double>* v : {&line.lower, &line.upper, &line.estimate}) v->assign(bands, 0.0);
    for (const std::uint32_t k : polygons) line.area_m2 += areas_m2_[k];
    for (std::size_t band = 0; band < bands && line.area_m2 > 0.0; ++band) {
      for (const std::uint32_t k : polygons) {
        const double share = areas_m2_[k] / line.area_m2;
        line.estimate[band] += share * estimate_[k][band];
        line.lower[band] += share * bounds_.polygons[k][band].lo;
        line.upper[band] += share * bounds_.polygons[k][band].hi;
      }
      if (known != nullptr) {
        line.lower[band] = std::max(line.lower[band], (*known)[band].lo);
        line.upper[band] = std::min(line.upper[band], (*known)[band].hi);
      }
      line.lower[band] = std::max(0.0, line.lower[band] * (1.0 - rounding));
      line.upper[band] *= 1.0 + rounding;
    }
  }

  std::string head() const {
    std::string csv = "kind,name";
    const std::size_t bands = bands_of_file(scene_);
    const auto numbered = [&](const char* name, std::size_t band) {
      return bands == 1 ? fmt::format(",{}", name) : fmt::format(",{}_{}", name, band);
    };
    for (std::size_t band = 0; band < bands; ++band)
      csv += numbered("lower", band) + numbered("upper", band);
    for (std::size_t band = 0; band < bands; ++band) csv += numbered("estimate", band);
    return csv + ",area_m2,index,group,unit\n";
  }

  std::string text(const Line& line) const {
    std::string csv = fmt::format("{},{}", line.kind, csv_field(line.name));
    const auto out = std::back_inserter(csv);
    const Spectrum lower = in_bands_of_file(scene_, line.lower);
    const Spectrum upper = in_bands_of_file(scene_, line.upper);
    const Spectrum estimate = in_bands_of_file(scene_, line.estimate);
    for (std::size_t band = 0; band < lower.size(); ++band) {
      if (line.area_m2 > 0.0) {
        fmt::format_to(out, ",{:.10g},{:.10g}", lower[band], upper[band]);
      } else {
        csv += ",,";
      }
    }
    for (const double e : estimate) csv += line.area_m2 > 0.0 ? fmt::format(",{:.6g}", e) : ",";
    fmt::format_to(out, ",{:.6g},{},{},{}\n", line.area_m2, line.place, csv_field(line.group),
                   irradiance_label(scene_.unit));
    return csv;
  }

 private:
  const Scene& scene_;
  const BoundResult& bounds_;
  std::vector<std::vector<double>> estimate_;
  std::vector<double> areas_m2_;
};

/// The building's room whose box holds most of the cell's area; null where none holds half of it.
const BuildingRoom* room_of_cell(const Prepared& prepared, CellId cell) {
  const std::vector<BuildingRoom>& rooms = prepared.scene.building.rooms;
  std::vector<double> inside(rooms.size(), 0.0);
  double whole = 0.0;
  for (const Cluster& cluster : prepared.clusters) {
    if (cluster.cell != cell) continue;
    for (const ClusterPolygon& p : cluster.polygons) {
      const double area = area_m2(p.polygon);
      whole += area;
      for (std::size_t i = 0; i < rooms.size(); ++i) {
        if (rooms[i].box.contains(centroid(p.polygon), 1e-3 * rooms[i].box.diagonal()))
          inside[i] += area;
      }
    }
  }
  const auto most = std::max_element(inside.begin(), inside.end());
  if (most == inside.end() || *most < 0.5 * whole) return nullptr;
  return &rooms[static_cast<std::size_t>(most - inside.begin())];
}

}  // namespace

BoundedRun bounded_run(const Prepared& prepared) {
  BoundedRun run;
  run.scene.bands = static_cast<std::size_t>(prepared.scene.bands);
  run.scene.lights = prepared.scene.lights;
  std::vector<std::vector<std::uint32_t>> of_cell(prepared.cells.cells().size());
  for (const Cluster& cluster : prepared.clusters) {
    for (const ClusterPolygon& p : cluster.polygons) {
      const Surface& surface = prepared.scene.surfaces[p.surface.index()];
      of_cell[cluster.cell.index()].push_back(
          static_cast<std::uint32_t>(run.scene.polygons.size()));
      run.scene.polygons.push_back(
          {p.polygon, surface.reflectance, surface.exitance, surface.transmittance, p.pane});
      run.surface_of.push_back(p.surface);
    }
  }
  for (std::size_t c = 0; c < of_cell.size(); ++c) {
    if (of_cell[c].empty() || prepared.cells.cells()[c].kind == CellKind::solid) continue;
    run.scene.targets.push_back(std::move(of_cell[c]));
    run.cells.push_back(prepared.cells.cells()[c].id);
  }
  return run;
}

std::string name_of_cell(const Prepared& prepared, CellId cell) {
  const BuildingRoom* room = room_of_cell(prepared, cell);
  if (room != nullptr && !room->name.empty()) return room->name;
  return fmt::format("cell {}", cell.value);
}

std::string bounds_csv(const Prepared& prepared, const BoundedRun& run, const BoundResult& bounds,
                       const std::vector<ClusterState>& solution) {
  const TableMaker maker(prepared, run, bounds, solution);
  std::string csv = maker.head();
  std::vector<std::uint32_t> all(run.scene.polygons.size());
  std::iota(all.begin(), all.end(), 0u);
  Line scene{.kind = "scene"};
  maker.fill(scene, all, &bounds.scene);
  csv += maker.text(scene);
  for (std::size_t t = 0; t < run.cells.size(); ++t) {
    const CellId cell = run.cells[t];
    const bool outside = prepared.cells.cells()[cell.index()].kind == CellKind::outside;
    const BuildingRoom* room = room_of_cell(prepared, cell);
    Line line{.kind = outside ? "outside" : "room",
              .name = name_of_cell(prepared, cell),
              .place = fmt::format("{}", cell.value),
              .group = room != nullptr ? room->storey : ""};
    maker.fill(line, run.scene.targets[t], &bounds.targets[t]);
    csv += maker.text(line);
  }
  std::vector<std::vector<std::uint32_t>> of_surface(prepared.scene.surfaces.size());
  for (std::uint32_t k = 0; k < run.surface_of.size(); ++k)
    of_surface[run.surface_of[k].index()].push_back(k);
  for (std::size_t i = 0; i < of_surface.size(); ++i) {
    const Surface& surface = prepared.scene.surfaces[i];
    Line line{.kind = "surface",
              .name = surface.name,
              .place = fmt::format("{}", i),
              .group = surface.object};
    maker.fill(line, of_surface[i], nullptr);
    csv += maker.text(line);
  }
  return csv;
}

}  // namespace enfilade
