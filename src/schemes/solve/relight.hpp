// A solve that begins with the links of another: of a scene with the same geometry, and other lamps
// or reflectances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/prepare.hpp"
#include "run/solution.hpp"

namespace enfilade {

/// What is kept of the solution before. "New" is of the scene that is solved, "old" of that one.
struct Relight {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::string from;                      ///< RUN of the solution before, or what stands for it
  std::vector<std::uint32_t> old_light;  ///< of each new light, whose links stand; else none
  std::vector<std::uint32_t> old_band;   ///< of each new band
};

/// Returns, of each of the new lights, the old one of the same place, opening, aim and
/// distribution, that was lit.
std::vector<std::uint32_t> lights_with_links(const Scene& now, const Scene& before);
/// Returns of each band of `now` the band of `before` with the light of the same band of the file.
/// Throws InputError where the files have different numbers of bands.
std::vector<std::uint32_t> bands_before(const Scene& now, const Scene& before);

/// Makes the clusters before the first iteration: with the patches, light and links of the solution
/// before. The links between patches are as they were and are not refined (Link::finest). To be
/// evaluated anew are links from lights that are new, or shine otherwise, or were dark; links from
/// shooters that were dark; and links from far nodes, whose transport depends on the distribution
/// of light in the node. A cluster with polygons that no light reached before begins anew.
class RelitClusters {
 public:
  /// All must outlive it.
  RelitClusters(const Relight& relight, const Prepared& prepared);

  /// `initial`: InitialClusters::make() of the new scene.
  ClusterState make(ClusterState initial) const;

 private:
  LinkSet links_of(const ClusterState& old) const;

  const Relight& relight_;
  const Prepared& prepared_;
  std::optional<SolutionReader> solution_;  ///< the one before
};

}  // namespace enfilade
