#include "scene/scene_limits.hpp"

#include "base/error.hpp"
#include "base/limits.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

/// Of a sum of two shares that are written with a few digits.
constexpr double rounding = 1e-9;

class Gate {
 public:
  explicit Gate(const Scene& scene) : scene_(scene) {}

  void surfaces() const {
    const char* const unit_hint = "check the numbers and the unit of length";
    refuse("surfaces",
           limits::fault_of_count(scene_.surfaces.size(), limits::most_items, "surfaces"));
    Box box;
    for (std::size_t s = 0; s < scene_.surfaces.size(); ++s) {
      const Surface& surface = scene_.surfaces[s];
      if (const auto fault =
              limits::fault_of_count(surface.vertices.size(), limits::most_corners, "corners"))
        refuse(label(scene_, SurfaceId(s)) + ".vertices", fault);
      for (const Vec3& p : surface.vertices) {
        if (limits::fault_of_place(p))
          refuse(label(scene_, SurfaceId(s)) + ".vertices",
                 {"a vertex lies beyond 1e9 m", unit_hint});
        box.add(p);
      }
      light(surface.exitance, [&] { return label(scene_, SurfaceId(s)) + ".exitance"; });
      for (std::size_t b = 0; b < surface.transmittance.size(); ++b) {
        if (surface.transmittance[b] + surface.reflectance[b] > 1.0 + rounding)
          refuse(label(scene_, SurfaceId(s)) + ".transmittance",
                 {"and reflectance are more than 1 together",
                  "a pane passes what it does not reflect: lower one of them"});
      }
    }
    // A scene of one point has no area, which is told later, and is not too small.
    if (!box.empty() && box.diagonal() > 0.0 && box.diagonal() < limits::smallest_extent_m) {
      refuse("surfaces", {"the scene extends over less than 1e-6 m in all", unit_hint});
    }
  }

  void lights() const {
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const auto where = [i] { return "lights[" + std::to_string(i) + "]"; };
      if (const auto fault = limits::fault_of_place(scene_.lights[i].p))
        refuse(where() + ".p", fault);
      light(scene_.lights[i].intensity, [&] { return where() + ".intensity"; });
    }
  }

  void probes() const {
    for (std::size_t i = 0; i < scene_.probes.size(); ++i) {
      const std::string where = "probes[" + std::to_string(i) + "]";
      refuse(where + ".p", limits::fault_of_place(scene_.probes[i].p));
      refuse(where + ".n", limits::fault_of_direction(scene_.probes[i].n));
    }
  }

 private:
  /// `where` is a function, since a building has 10^6 surfaces and no fault.
  template <class Where>
  void light(const Spectrum& bands, Where where) const {
    if (const auto fault = limits::fault_of_count(bands.size(), limits::most_bands, "bands"))
      refuse(where(), fault);
    for (const double band : bands) {
      if (const auto fault = limits::fault_of_light(band))
        refuse(where(), {"is " + fault.what, fault.hint});
    }
  }
  void refuse(const std::string& where, const limits::Fault& fault) const {
    if (fault) throw InputError(scene_.file, where, fault.what, fault.hint);
  }

  const Scene& scene_;
};

}  // namespace

void check_limits(const Scene& scene) {
  const Gate gate(scene);
  gate.surfaces();
  gate.lights();
  gate.probes();
}

std::string label(const Scene& scene, SurfaceId id) {
  const std::string& name = scene.surfaces[id.index()].name;
  std::string where = "surfaces[" + std::to_string(id.value) + "]";
  if (!name.empty()) where.append(" ").append(in_quotes(name));
  return where;
}

}  // namespace enfilade
