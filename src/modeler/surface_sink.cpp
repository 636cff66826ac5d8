#include "modeler/surface_sink.hpp"

#include <cmath>
#include <numbers>

namespace enfilade {
namespace {

// Nanometres: far below any tolerance, and numbers of few digits in the file.
double rounded(double x) { return std::round(x * 1e9) / 1e9 + 0.0; }

}  // namespace

SurfaceSink::SurfaceSink(const Building& building, Receiver receiver)
    : receiver_(std::move(receiver)),
      colours_(building.colours),
      lamp_exitance_(building.lamp_exitance),
      furnace_(building.furnace),
      cos_(std::cos(building.rotate_deg * std::numbers::pi / 180.0)),
      sin_(std::sin(building.rotate_deg * std::numbers::pi / 180.0)) {}

Vec3 SurfaceSink::placed(const Vec3& p) const {
  return {rounded(cos_ * p.x - sin_ * p.y), rounded(sin_ * p.x + cos_ * p.y), rounded(p.z)};
}

void SurfaceSink::emit(Polygon polygon, const Finish& finish, const char* name, double exitance) {
  Surface surface;
  for (Vec3& p : polygon) p = placed(p);
  surface.vertices = std::move(polygon);
  surface.reflectance = reflectance_of(finish, colours_);
  for (const double rho : surface.reflectance) {
    surface.exitance.push_back(furnace_ > 0.0 ? (1.0 - rho) * furnace_ : exitance);
  }
  surface.name = name;
  surface.object = object_;
  receiver_(surface);
}

}  // namespace enfilade
