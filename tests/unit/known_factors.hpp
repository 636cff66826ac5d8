// The public set of form factors (tests/accuracy/form_factors), for tests of all that computes one.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/polygon.hpp"
#include "unit/gather/box_room.hpp"
#include "unit/source_files.hpp"

namespace enfilade::testing {

/// A form factor to polygon `shooter`: from a point, or the mean over polygon `receiver`.
struct KnownFactor {
  std::string name;
  Vec3 x{0.0}, n{0.0, 0.0, 1.0};  ///< of a point
  Polygon receiver;               ///< empty: a point
  Polygon shooter;
  std::vector<Polygon> occluders;  ///< opaque from both sides
  double factor = 0.0;
  Vec3 moment{0.0};  ///< of a point: integral of the kernel times (y - first corner), m
  bool from_point() const { return receiver.empty(); }
};

inline std::vector<KnownFactor> known_factors() {
  const std::string file = source_file("tests/accuracy/form_factors/form_factors.json");
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": is not there");
  const auto point = [](const nlohmann::json& p) { return Vec3(p[0], p[1], p[2]); };
  const auto polygon = [&](const nlohmann::json& corners) {
    Polygon found;
    for (const nlohmann::json& p : corners) found.push_back(point(p));
    return found;
  };
  std::vector<KnownFactor> known;
  const nlohmann::json all = nlohmann::json::parse(in);
  for (const nlohmann::json& pair : all.at("pairs")) {
    KnownFactor next;
    next.name = pair.at("name");
    next.shooter = polygon(pair.at("Q"));
    for (const nlohmann::json& o : pair.at("occluders")) next.occluders.push_back(polygon(o));
    if (pair.contains("P")) {
      next.receiver = polygon(pair.at("P"));
      next.factor = pair.at("F_PQ");
    } else {
      next.x = point(pair.at("x"));
      next.n = point(pair.at("n"));
      next.factor = pair.at("F");
      next.moment = point(pair.at("moment"));
    }
    known.push_back(next);
  }
  if (known.size() < 80) throw std::runtime_error(file + ": pairs are missing");
  return known;
}

/// The scene of a known factor, each polygon a cluster of its own: first the shooter with exitance
/// 1, then black occluders, then the receiver; from a point, a black plate far below instead.
inline Scene scene_of(const KnownFactor& known) {
  Scene scene;
  scene.bands = 1;
  const auto add = [&](const Polygon& corners, double exitance) {
    Surface surface;
    surface.vertices = corners;
    surface.reflectance = {0.0};
    surface.exitance = {exitance};
    scene.surfaces.push_back(surface);
  };
  add(known.shooter, 1.0);
  for (const Polygon& occluder : known.occluders) add(occluder, 0.0);
  add(known.from_point() ? Polygon{{-5, -5, -6}, {5, -5, -6}, {5, 5, -6}, {-5, 5, -6}}
                         : known.receiver,
      0.0);
  return scene;
}

}  // namespace enfilade::testing
