// Random walks by ray casting, and next-event estimation at each step.
#include "clusters/light_walk.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

constexpr int steps_from_dark = 8;
/// Lights and emitting pieces that count as near to a cell: those of a room and its neighbours.
constexpr std::size_t near_sources = 16;
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

RayScene rays_of(const Scene& scene, std::span<const CellPiece> pieces) {
  std::vector<Polygon> polygons;
  std::vector<char> panes;
  polygons.reserve(pieces.size());
  for (const CellPiece& piece : pieces) {
    polygons.push_back(piece.piece.polygon);
    panes.push_back(scene.surfaces[piece.piece.surface.index()].is_pane() ? 1 : 0);
  }
  return RayScene(polygons, panes);
}

}  // namespace

LightWalk::LightWalk(const Scene& scene, std::span<const CellPiece> pieces, double offset_m,
                     int max_bounces)
    : lights_(scene.lights),
      pieces_(pieces),
      offset_m_(offset_m),
      max_bounces_(max_bounces),
      rays_(rays_of(scene, pieces)) {
  faces_.reserve(pieces.size());
  for (const CellPiece& piece : pieces) {
    const Surface& surface = scene.surfaces[piece.piece.surface.index()];
    const bool emits = std::any_of(surface.exitance.begin(), surface.exitance.end(),
                                   [](double e) { return e > 0.0; });
    if (emits) emitters_.push_back(static_cast<std::uint32_t>(faces_.size()));
    faces_.push_back({normal(piece.piece.polygon), emits});
    ENFILADE_CHECK(piece.cell.valid(), std::to_string(faces_.size()));
    last_found_.resize(std::max(last_found_.size(), piece.cell.index() + 1), none);
  }
  nearest_.resize(last_found_.size());
  std::vector<Box> places(lights_.size() + emitters_.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i].add(place_of(i));
  places_ = BoxTree(places);
}

bool LightWalk::finds_light(std::size_t piece, const Vec3& p, const Vec3& n, int walks,
                            Random& random) {
  for (int i = 0; i < walks; ++i) {
    if (one_walk(piece, p, n, random)) return true;
  }
  return false;
}

bool LightWalk::one_walk(std::size_t piece, Vec3 p, Vec3 n, Random& random) {
  int steps = 0;
  while (steps < max_bounces_) {
    p += offset_m_ * n;
    ++steps_;
    if (finds_light_from(piece, p, n, random)) return true;
    const double r2 = random.uniform(), turn = random.uniform();
    const Vec3 d = cosine_direction(n, r2, turn);
    const RayHit hit = rays_.closest(p, d);
    if (!hit.any() || !hit.front) return false;
    piece = hit.polygon;
    if (faces_[piece].emits) return true;
    steps += faces_[piece].dark ? steps_from_dark : 1;
    p += hit.distance_m * d;
    n = faces_[piece].n;
  }
  return false;
}

/// A point is tested by many walks of many steps, so that all lights get their turn.
bool LightWalk::finds_light_from(std::size_t piece, const Vec3& p, const Vec3& n, Random& random) {
  const std::size_t count = lights_.size() + emitters_.size();
  if (count == 0) return false;
  std::size_t& last = last_found_[pieces_[piece].cell.index()];
  if (last < count && sees(last, p, n, random)) return true;
  const std::size_t any = draw_source(pieces_[piece].cell, p, random);
  if (any == last || !sees(any, p, n, random)) return false;
  last = any;
  return true;
}

Vec3 LightWalk::place_of(std::size_t source) const {
  if (source < lights_.size()) return lights_[source].p;
  return pieces_[emitters_[source - lights_.size()]].piece.polygon.front();
}

/// Of all sources (there is at least one), or of those nearest to a point of the cell.
std::size_t LightWalk::draw_source(CellId cell, const Vec3& p, Random& random) {
  const std::size_t count = lights_.size() + emitters_.size();
  if (count <= near_sources || random.below(2) == 0) return random.below(count);
  std::vector<std::uint32_t>& nearest = nearest_[cell.index()];
  if (nearest.empty()) nearest = places_.nearest(p, near_sources);
  return nearest[random.below(near_sources)];
}

bool LightWalk::sees(std::size_t light, const Vec3& p, const Vec3& n, Random& random) const {
  return light < lights_.size() ? sees_light(p, n, lights_[light], random)
                                : sees_emitter(p, n, emitters_[light - lights_.size()], random);
}

bool LightWalk::sees_light(const Vec3& p, const Vec3& n, const LightSource& light,
                           Random& random) const {
  Vec3 y = light.p;
  if (!light.opening.empty()) {
    const double r1 = random.uniform(), r2 = random.uniform();
    y = point_on(light, r1, r2);
  }
  return glm::dot(y - p, n) > 0.0 && relative_intensity(light, p - y) > 0.0 &&
         !rays_.occluded(p, y);
}

bool LightWalk::sees_emitter(const Vec3& p, const Vec3& n, std::uint32_t emitter,
                             Random& random) const {
  const Polygon& polygon = pieces_[emitter].piece.polygon;
  const Vec3 q = random_point(polygon, random);
  if (glm::dot(q - p, n) <= 0.0 || glm::dot(p - q, faces_[emitter].n) <= 0.0) return false;
  return !rays_.occluded(p, q, RayScene::no_polygon, emitter);
}

}  // namespace enfilade
