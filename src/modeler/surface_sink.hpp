// Takes finished polygons, turns them as the building is turned, gives them reflectance and
// exitance and hands them on one by one.
#pragma once

#include <functional>
#include <string>

#include "modeler/building.hpp"
#include "modeler/material.hpp"

namespace enfilade {

class SurfaceSink {
 public:
  using Receiver = std::function<void(const Surface&)>;
  SurfaceSink(const Building& building, Receiver receiver);

  /// Polygons that follow belong to this object.
  void begin_object(std::string object) { object_ = std::move(object); }
  /// Planar, convex, counter-clockwise from the reflecting side, in the building's own frame.
  void add(Polygon polygon, const Finish& finish, const char* name) {
    emit(std::move(polygon), finish, name, 0.0);
  }
  /// The same, with the exitance of a lamp.
  void add_light(Polygon polygon, const Finish& finish, const char* name) {
    emit(std::move(polygon), finish, name, lamp_exitance_);
  }
  /// p, turned as the building is.
  Vec3 placed(const Vec3& p) const;

 private:
  void emit(Polygon polygon, const Finish& finish, const char* name, double exitance);

  Receiver receiver_;
  bool colours_;
  double lamp_exitance_, furnace_, cos_, sin_;
  std::string object_;
};

}  // namespace enfilade
