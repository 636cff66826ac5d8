#include "import/intake/mesh_surfaces.hpp"

#include <array>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "json/json_text.hpp"
#include "scene/convex_parts.hpp"

namespace enfilade {
namespace {

/// The first point at each place: formats repeat points to give each face its own normal.
std::vector<std::uint32_t> first_of_each(const std::vector<Vec3>& points) {
  std::map<std::array<double, 3>, std::uint32_t> first_at;
  std::vector<std::uint32_t> first(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    first[i] = first_at.try_emplace({points[i].x, points[i].y, points[i].z}, i).first->second;
  return first;
}

Polygon corners_of(const IndexLoop& loop, const std::vector<Vec3>& points) {
  Polygon polygon;
  for (const std::uint32_t i : loop) polygon.push_back(points[i]);
  return polygon;
}

SceneScale scale_of(const std::vector<Vec3>& points) {
  Scene scene;
  scene.surfaces.emplace_back().vertices = points;
  return SceneScale(scene);
}

}  // namespace

Spectrum reflectance_of(const Spectrum& colour, const std::string& where, Warnings& warnings) {
  constexpr double highest_reflectance = 0.95;
  Spectrum bands;
  bool clamped = false;
  for (const double c : colour) {
    bands.push_back(std::isfinite(c) ? std::clamp(c, 0.0, highest_reflectance) : 0.0);
    clamped |= bands.back() != c;
  }
  if (clamped) warnings.add(where, "base colour above 0.95: reflectance taken as 0.95");
  return bands;
}

void MeshSurfaces::reserve(std::size_t more) const {
  if (scene_.surfaces.size() + more <= most_surfaces) return;
  throw InputError(scene_.file, "model",
                   "has more than " + std::to_string(most_surfaces) + " surfaces",
                   "look for parts that repeat without end, or import parts of the model");
}

void MeshSurfaces::add_surface(Polygon vertices, const ModelMesh& mesh,
                               const ModelMaterial& material) {
  reserve(1);
  Surface& surface = scene_.surfaces.emplace_back();
  surface.vertices = std::move(vertices);
  surface.reflectance = material.reflectance;
  surface.exitance = material.exitance;
  surface.transmittance = material.transmittance;
  surface.two_sided = material.two_sided;
  surface.name = mesh.name;
  surface.object = mesh.object;
}

void MeshSurfaces::add(const ModelMesh& mesh, const ModelMaterial& material) {
  if (mesh.faces.empty()) return;
  if (material.open) {
    warnings_.add(in_quotes(mesh.object), "transparent: left out, light passes");
    return;
  }
  Box box;
  for (const Vec3& p : mesh.points) {
    if (const auto fault = limits::fault_of_place(p)) {
      throw InputError(scene_.file, mesh.name.empty() ? "mesh" : "mesh " + in_quotes(mesh.name),
                       "has a point that " + fault.what, fault.hint);
    }
    box.add(p);
  }
  const std::vector<std::uint32_t> first = first_of_each(mesh.points);
  const SceneScale scale = scale_of(mesh.points);
  std::vector<IndexLoop> joinable;
  for (IndexLoop loop : mesh.faces) {
    for (std::uint32_t& i : loop) i = first[i];
    if (loop.size() == 3) {
      if (loop[0] != loop[1] && loop[1] != loop[2] && loop[2] != loop[0]) joinable.push_back(loop);
      continue;
    }
    const ConvexParts parts = convex_parts(corners_of(loop, mesh.points), scale);
    if (parts.shape == PolygonShape::convex) {
      joinable.push_back(std::move(loop));
    } else if (parts.shape == PolygonShape::self_intersecting) {
      warnings_.add(in_quotes(mesh.object), "polygon that crosses itself: left out");
    } else if (parts.shape != PolygonShape::degenerate) {
      for (const Polygon& part : parts.parts) add_surface(part, mesh, material);
    }
  }
  // Single precision leaves relative errors of 1e-7 of the coordinates; flat is what survives that.
  const double flat = 1e-5 * box.diagonal();
  for (const IndexLoop& loop : merge_convex(mesh.points, std::move(joinable), flat, 1e-4))
    add_surface(corners_of(loop, mesh.points), mesh, material);
}

void check_shapes(const Scene& scene, const Warnings& warnings) {
  if (!scene.surfaces.empty()) return;
  throw InputError(scene.file, "file",
                   warnings.empty()
                       ? "holds no shapes"
                       : "holds no shape that can be imported (" + warnings.summary(1)[0] + ")",
                   "export the model with its geometry");
}

}  // namespace enfilade
