#include "report/pictures/scene_tone.hpp"

#include "scene/equal_bands.hpp"

namespace enfilade {

ToneMap scene_tone_map(const SolvedScene& solved, const ToneConfig& config) {
  std::vector<std::pair<double, double>> luminances;
  for (const ClusterState& state : solved.states) {
    const PatchForest& forest = state.patches();
    for (std::size_t i = 0; i < forest.size(); ++i) {
      if (!forest.node(i).leaf()) continue;
      Spectrum mean;
      for (std::size_t t = 0; t < forest.radiosity(i).size();
           t += static_cast<std::size_t>(forest.terms())) {
        mean.push_back(forest.radiosity(i)[t]);
      }
      luminances.emplace_back(luminance(display_rgb(in_bands_of_file(solved.scene, mean))),
                              forest.node(i).shape.area_m2);
    }
  }
  return ToneMap(std::move(luminances), config);
}

}  // namespace enfilade
