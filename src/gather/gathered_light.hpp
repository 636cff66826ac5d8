// The irradiance that links bring to the nodes of one receiving cluster's hierarchy.
#pragma once

#include <span>
#include <vector>

#include "far_field/building_light.hpp"
#include "hierarchy/cluster_state.hpp"
#include "hierarchy/link.hpp"

namespace enfilade {

/// Reads the light of shooters and sums, link by link, the irradiance at the receiving nodes.
class GatheredLight {
 public:
  /// `receiver` may get more patches between the calls. All must outlive the object. `far`: null
  /// where no link has a far shooter.
  GatheredLight(const PatchForest& receiver, std::span<const LightSource> lights,
                const BuildingLight* far);

  /// Reads the light that the link's shooter sends: a node of `shooter`, or a point light or a far
  /// node where that is null. Returns its RMS variation over the shooter (worst band), as
  /// NodeLight::variation has it.
  double read(const Link& link, const PatchForest* shooter);
  /// Returns the light of the shooter read last: mean radiosity per band, or a point light's
  /// intensity.
  std::span<const double> means() const { return means_; }
  /// Returns the largest of these, without sign, of the lead bands.
  double most() const;
  /// Returns the reflected radiosity of a far shooter read last.
  double reflected(std::size_t band) const { return light_[band * terms_]; }
  /// Adds the light read last, by the link's transport, to the irradiance of its receiver.
  void receive(const Link& link, std::span<const float> transport);

  /// Returns the irradiance, indexed like the light of the patches, with room for patches made
  /// since.
  std::vector<double>& irradiance();
  /// Returns per band the sum of area times irradiance over all nodes.
  Spectrum power() const;

 private:
  double read_light(const Link& link, const PatchForest* shooter);
  void receive_group(const Link& link, std::span<const float> transport);
  void receive_patch(const Link& link, std::span<const float> transport);

  const PatchForest& receiver_;
  std::span<const LightSource> lights_;
  const BuildingLight* far_;
  std::size_t bands_, terms_;
  std::vector<double> irradiance_;
  std::vector<double> light_, means_;  ///< of the shooter read last: as the basis has it; per band
  std::vector<double> emitted_;        ///< of a far shooter: mean exitance per band; else empty
};

}  // namespace enfilade
