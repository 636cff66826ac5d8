// The light of a picture, gathered from the solution at some of its pixels and smoothed between
// them: without the patches' edges, and with shadows where they belong.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "final_gather/emitter_sampler.hpp"
#include "occluders/light_at.hpp"
#include "report/pictures/first_surfaces.hpp"

namespace enfilade {

struct GatherQuality {
  int rays = 64;      ///< over the hemisphere of each place, for light that surfaces reflect
  int every_px = 8;   ///< distance of these places in the picture
  int direct_px = 4;  ///< distance of the places at which the light of lamps is found
  int threads = 0;    ///< 0 = as many as the machine has
  std::uint64_t seed = 1;
};

/// The light at a place for pictures: less exact than PointGather, and a hundred times as fast.
/// Bright emitters count by their mean radiosity; a large one by its closed-form factor and six
/// shadow rays, the small ones together by six shadow rays, each to one of them that is picked by
/// its light if nothing hid it. What rays meet has the light of its patch.
class QuickGather {
 public:
  /// `solved` must outlive it.
  QuickGather(const SolvedScene& solved, int rays);

  /// Adds the irradiance per band that lamps and other bright emitters give at p, on polygon `own`
  /// with unit normal n.
  void add_direct(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                  std::span<double> e) const;
  /// Adds that of all other surfaces, and of the sky, whose shadows are soft, by rays.
  void add_reflected(const Vec3& p, const Vec3& n, std::uint32_t own, Random& random,
                     std::span<double> e) const;

 private:
  void add_sky(const LitPlace& place, Random& random, std::span<double> e) const;
  void add_emitter(const EmitterSampler::Emitter& emitter, const LitPlace& place, double weight,
                   int rays, Random& random, std::span<double> e) const;
  void add_bright(const LitPlace& place, Random& random, std::span<double> e) const;

  const SolvedScene& solved_;
  int rays_;
  EmitterSampler sampler_;
};

/// Gathered before the picture is painted; then light at any place that the picture shows.
class PictureLight {
 public:
  PictureLight(const SolvedScene& solved, const FirstSurfaces& surfaces,
               const GatherQuality& quality, const Progress& progress = {});

  /// Writes the irradiance per band of `polygon` where it shows in the pixel (x, y); false where
  /// nothing was gathered in its plane nearby.
  bool at(int x, int y, std::uint32_t polygon, std::span<double> e) const;
  /// True where two polygons lie in one plane: the light of one counts for the other.
  bool same_plane(std::uint32_t a, std::uint32_t b) const { return planes_[a] == planes_[b]; }
  /// Returns the number of places at which rays over the hemisphere were cast.
  std::size_t places() const { return reflected_.places.size(); }

 private:
  /// A place that was gathered at: what the first ray of a pixel met. In averages it counts as the
  /// pixel's middle.
  struct Place {
    int x, y;
    std::uint32_t plane, polygon;
    Vec3 p;
  };
  /// A grid over the picture; each of its cells has one place in each plane that it shows.
  struct Layer {
    int step_px = 1, columns = 0, rows = 0;
    double width_steps = 1.0;        // of the Gaussian
    std::vector<double> gaussian;    // at 0, 1, 2... pixels
    std::vector<std::size_t> first;  // of each cell, and the end
    std::vector<Place> places;
    std::vector<double> light;  // of each place, per band
  };

  void find_places(Layer& layer, int step_px, const FirstSurfaces& surfaces) const;
  bool add(const Layer& layer, int x, int y, std::uint32_t plane, std::span<double> e) const;

  const SolvedScene& solved_;
  std::size_t bands_;
  std::vector<std::uint32_t> planes_;  // of each polygon
  Layer direct_, reflected_;
};

}  // namespace enfilade
