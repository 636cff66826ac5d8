// Where the light of a scene goes first: told before a solve, since a solve of darkness converges.
#pragma once

#include "base/warnings.hpp"
#include "scene/scene.hpp"

namespace enfilade {

/// Power of all lamps per band, W or lm, and how many surfaces give it.
struct LightSources {
  Spectrum power;
  std::size_t surfaces = 0;
};
LightSources light_sources(const Scene& scene);

/// Warns where the scene has no light, where most of the light falls on the black backs of
/// surfaces (named, those first that most falls on), and where a lamp lights little but what stands
/// close before it. Casts some 10,000 rays, the same each time.
void survey_light(const Scene& scene, Warnings& warnings);

/// Estimates by rays how much of the light of sky, sun and ground meets fronts of the scene
/// (LightSource::arriving). After make_lights().
void survey_far_lights(Scene& scene);

}  // namespace enfilade
