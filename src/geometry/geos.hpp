// GEOS, with what it makes freed by itself. Only for .cpp files that link GEOS::geos_c.
#pragma once

#include <geos_c.h>

#include <memory>
#include <vector>

#include "base/geometry.hpp"

namespace enfilade {

/// A context of its own, so that threads do not share one. Its geometries must not outlive it.
class Geos {
 public:
  struct Free {
    GEOSContextHandle_t handle;
    void operator()(GEOSGeometry* g) const { GEOSGeom_destroy_r(handle, g); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Free>;

  Geos() : handle_(GEOS_init_r()) {}
  ~Geos() { GEOS_finish_r(handle_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  GEOSContextHandle_t handle() const { return handle_; }

  Geometry own(GEOSGeometry* g) const { return {g, Free{handle_}}; }

  /// Returns a polygon without holes; none where it has too few points.
  Geometry polygon(const std::vector<Vec2>& ring) const {
    const auto count = static_cast<unsigned>(ring.size());
    GEOSCoordSequence* points = GEOSCoordSeq_create_r(handle_, count + 1, 2);
    for (unsigned i = 0; i <= count; ++i) {
      GEOSCoordSeq_setXY_r(handle_, points, i, ring[i % count].x, ring[i % count].y);
    }
    GEOSGeometry* shell = GEOSGeom_createLinearRing_r(handle_, points);
    return own(shell == nullptr ? nullptr : GEOSGeom_createPolygon_r(handle_, shell, nullptr, 0));
  }

 private:
  GEOSContextHandle_t handle_;
};

}  // namespace enfilade
