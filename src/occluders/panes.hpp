// The panes of a scene: polygons that light passes straight through, dimmed by the angle.
#pragma once

#include <span>
#include <vector>

#include "clusters/cluster.hpp"
#include "geometry/shaft_tree.hpp"
#include "occluders/passage.hpp"
#include "raycast/ray_scene.hpp"

namespace enfilade {

/// Knows the panes by the global numbers of their polygons.
class Panes {
 public:
  explicit Panes(std::span<const Cluster> clusters);

  bool any() const { return !polygons_.empty() || !backs_.empty(); }
  /// True of a pane and of the back of one.
  bool contains(std::uint32_t polygon) const;
  /// Dims the light by one crossing; the back of a two-sided pane dims nothing.
  void dim(Passage& passage, std::uint32_t polygon, double cosine) const;
  /// Appends the panes other than skip_a and skip_b that meet the convex hull of a and b.
  void find_between(const Polygon& a, const Polygon& b, double tolerance_m, std::uint32_t skip_a,
                    std::uint32_t skip_b, std::vector<std::uint32_t>& found) const;

 private:
  struct Pane {
    double most = 1.0;         ///< transmittance at normal incidence of the band that passes most
    std::vector<double> tint;  ///< of the other bands, relative to it; empty: grey
  };
  std::size_t index_of(std::uint32_t polygon) const;

  std::vector<std::uint32_t> polygons_, backs_;  ///< ascending
  std::vector<Pane> panes_;
  ShaftTree shafts_;
};

}  // namespace enfilade
