// Picking one lamp for a point at random, by what each lamp is likely to bring there.
#pragma once

#include <compare>
#include <span>
#include <vector>

#include "final_gather/emitter_sampler.hpp"
#include "occluders/light_at.hpp"

namespace enfilade {

/// Picks among the bright emitters and the lights. Rays from
/// each of them show once which polygons it lights. At a place on a polygon, one of the lamps that
/// light the polygon is picked by what it would bring if nothing hid it; now and then one of all
/// lamps by its distance, since few rays miss much (a mixture density, Veach 1997, chapter 9).
/// Refers to what it is made of.
class EmitterPicker {
 public:
  EmitterPicker(std::span<const EmitterSampler::Emitter> emitters,
                std::span<const LightSource> lights, const Occluders& occluders,
                std::uint64_t seed);

  /// Running sums of the lamps' probabilities by distance, not normalised, for places near p.
  std::vector<double> weights(const Vec3& p) const;
  /// Adds an unbiased estimate, by one ray, of share * the irradiance that all lamps give at
  /// `place`, of an emitter as its patches have it. `weights`: for any place.
  void add_picked(const LitPlace& place, std::span<const double> weights, Random& random,
                  std::span<const double> share, Spectrum& irradiance) const;

 private:
  /// A lamp's ray arrives at a polygon.
  struct Arrival {
    std::uint32_t polygon, lamp;
    auto operator<=>(const Arrival&) const = default;
  };
  std::size_t size() const { return emitters_.size() + lights_.size(); }
  std::span<const std::uint32_t> lit(std::uint32_t polygon) const;
  void shoot(std::uint32_t lamp, int rays, Random& random, std::vector<Arrival>& arrivals) const;
  double unoccluded(std::uint32_t lamp, const LitPlace& place) const;
  void add_emitter(const EmitterSampler::Emitter& emitter, const LitPlace& place, Random& random,
                   std::span<const double> share, Spectrum& irradiance) const;

  std::span<const EmitterSampler::Emitter> emitters_;
  std::span<const LightSource> lights_;
  const Occluders* occluders_;
  std::vector<double> radius_m_;      ///< of each light's opening
  std::vector<std::uint32_t> first_;  ///< per polygon, of lit_; one more than polygons
  std::vector<std::uint32_t> lit_;    ///< lamps
};

}  // namespace enfilade
