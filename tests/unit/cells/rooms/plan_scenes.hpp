// Small buildings made in code: boxes with doors, turned and moved as a test likes.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "scene/scene.hpp"

namespace enfilade::plan {

/// Collects one-sided rectangles.
class Plan {
 public:
  /// Corner, two edges; the front is along cross(u, v).
  void rectangle(const Vec3& corner, const Vec3& u, const Vec3& v) {
    polygons.push_back({corner, corner + u, corner + u + v, corner + v});
  }
  /// Both sides of a rectangle without thickness.
  void sheet(const Vec3& corner, const Vec3& u, const Vec3& v) {
    rectangle(corner, u, v);
    rectangle(corner, v, u);
  }
  /// The six faces of a box, seen from inside (a room) or from outside (furniture).
  void box(const Vec3& lo, const Vec3& hi, bool inward) {
    const Vec3 e = hi - lo, x(e.x, 0, 0), y(0, e.y, 0), z(0, 0, e.z);
    const auto face = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
      inward ? rectangle(corner, u, v) : rectangle(corner, v, u);
    };
    face(lo, x, y);
    face(lo, y, z);
    face(lo, z, x);
    face(lo + z, y, x);
    face(lo + x, z, y);
    face(lo + y, x, z);
  }
  /// A sheet across x = at with a door in it, from (y0, z0) to (y1, z1).
  void wall_with_door(double at, double y0, double y1, double height, double door0, double door1,
                      double door_height) {
    const Vec3 z(0, 0, height);
    sheet({at, y0, 0}, {0, door0 - y0, 0}, z);
    sheet({at, door1, 0}, {0, y1 - door1, 0}, z);
    sheet({at, door0, door_height}, {0, door1 - door0, 0}, {0, 0, height - door_height});
  }
  void transform(const std::function<Vec3(const Vec3&)>& move) {
    for (Polygon& polygon : polygons) {
      for (Vec3& p : polygon) p = move(p);
    }
  }
  /// As the program makes them: what stands on a floor covers it there.
  std::vector<Piece> pieces() const {
    Warnings warnings;
    return make_pieces(scene(), warnings);
  }
  Scene scene() const {
    Scene scene;
    for (const Polygon& polygon : polygons)
      scene.surfaces.push_back({polygon, {0.5}, {0.0}, "", "", false});
    return scene;
  }

  std::vector<Polygon> polygons;
};

inline Plan one_room() {
  Plan plan;
  plan.box({0, 0, 0}, {5, 4, 2.5}, true);
  return plan;
}

/// 4 x 4 and 6 x 4, the door 0.9 x 2.
inline Plan two_rooms() {
  Plan plan;
  plan.box({0, 0, 0}, {10, 4, 2.5}, true);
  plan.wall_with_door(4, 0, 4, 2.5, 1, 1.9, 2);
  return plan;
}

/// Two storeys of 8 x 6 with a slab 0.3 thick and a stair hole of 2 x 3 in it.
inline Plan two_storeys() {
  Plan plan;
  const double top = 5.8;
  plan.box({0, 0, 0}, {8, 6, top}, true);
  const auto slab = [&](double z, bool up) {
    const auto part = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
      up ? plan.rectangle(corner, u, v) : plan.rectangle(corner, v, u);
    };
    part({2, 0, z}, {6, 0, 0}, {0, 6, 0});
    part({0, 3, z}, {2, 0, 0}, {0, 3, 0});
  };
  slab(2.5, false);
  slab(2.8, true);
  plan.rectangle({2, 0, 2.5}, {0, 0, 0.3}, {0, 3, 0});
  plan.rectangle({0, 3, 2.5}, {2, 0, 0}, {0, 0, 0.3});
  return plan;
}

inline Plan l_corridor() {
  Plan plan;
  const double h = 2.5;
  plan.rectangle({0, 0, 0}, {6, 0, 0}, {0, 2, 0});
  plan.rectangle({0, 2, 0}, {2, 0, 0}, {0, 4, 0});
  plan.rectangle({0, 0, h}, {0, 2, 0}, {6, 0, 0});
  plan.rectangle({0, 2, h}, {0, 4, 0}, {2, 0, 0});
  const Vec3 z(0, 0, h);
  plan.rectangle({0, 0, 0}, z, {6, 0, 0});
  plan.rectangle({6, 0, 0}, z, {0, 2, 0});
  plan.rectangle({2, 2, 0}, {4, 0, 0}, z);
  plan.rectangle({2, 2, 0}, z, {0, 4, 0});
  plan.rectangle({0, 6, 0}, {2, 0, 0}, z);
  plan.rectangle({0, 0, 0}, {0, 6, 0}, z);
  return plan;
}

/// An oblique turn and a shift: far from every axis and from the origin.
inline std::function<Vec3(const Vec3&)> turn_and_move(double shift_m) {
  const Vec3 axis = glm::normalize(Vec3(0.3, -0.5, 0.8));
  return [=](const Vec3& p) {
    const double angle = 0.7, c = std::cos(angle), s = std::sin(angle);
    const Vec3 turned = c * p + s * glm::cross(axis, p) + (1.0 - c) * glm::dot(axis, p) * axis;
    return turned + Vec3(shift_m, -2.0 * shift_m, 0.5 * shift_m);
  };
}

}  // namespace enfilade::plan
