// What a camera sees: the first surface along each of its rays, of those that its cut leaves.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "report/pictures/camera.hpp"
#include "report/pictures/solved_scene.hpp"

namespace enfilade {

/// Refers to the scene and the camera, which must outlive it. Queries may come from several
/// threads.
class CameraView {
 public:
  CameraView(const SolvedScene& solved, const Camera& camera, double aspect);

  struct Seen {
    enum class What { nothing, section, back, front } what = What::nothing;
    std::uint32_t polygon = RayScene::no_polygon;  ///< of a front or a back
    Vec3 p{0.0};                                   ///< on the polygon
    struct Pane {
      PaneMet met;
      Vec3 p{0.0};  ///< on the pane
    };
    std::vector<Pane> panes{};  ///< between, from the nearest on
    /// Of a ray that leaves the building: where to. Zero where a cut or a parallel projection makes
    /// a drawing of the picture, which has no sky.
    Vec3 outward{0.0};
  };
  /// Returns what is seen at a place of the picture, whose edges are at -1 and 1; y points up.
  /// Section: the inside of a solid at the cut.
  Seen at(double x, double y) const;

 private:
  struct Ray {
    Vec3 from, direction;
  };
  struct Met {
    RayHit hit;
    Vec3 p{0.0};
  };
  enum class Outer : std::uint8_t { unknown, yes, no };

  Ray ray(double x, double y) const;
  Met first_seen(const Ray& ray, std::uint32_t skip) const;
  void find_panes(const Ray& ray, double distance_m, std::uint32_t skip, Seen& seen) const;
  Seen leaving(const Ray& ray, std::uint32_t skip) const;
  bool go_to_cut(Ray& ray) const;
  bool inside_solid(const Vec3& p) const;
  bool outer(std::uint32_t polygon) const;
  bool looks_outward(std::uint32_t polygon) const;

  const SolvedScene& solved_;
  const Camera& camera_;
  Vec3 forward_, right_, up_;
  /// Filled as rays meet polygons; no value depends on which thread fills it.
  std::unique_ptr<std::atomic<Outer>[]> outer_;
};

}  // namespace enfilade
