#include "solver/gather_plan.hpp"

#include "occluders/unreachable_polygons.hpp"

namespace enfilade {
namespace {

/// Points in a scene at which errors are sampled.
constexpr double sampled_points = 256.0;

/// Half of the points are spread by area, half by the power that arrives.
ErrorSampleConfig error_samples(const IterationPlan& plan, double area_m2) {
  ErrorSampleConfig config;
  if (plan.received_power <= 0.0 || area_m2 <= 0.0) return config;
  config.rays = plan.sample_rays;
  config.per_area = 0.5 * sampled_points / area_m2;
  config.per_power = 0.5 * sampled_points / plan.received_power;
  config.mean_irradiance = plan.received_power / area_m2;
  return config;
}

}  // namespace

GatherConfig gather_config(const IterationPlan& plan, const GatherSettings& settings,
                           const IterationMethod& method, double area_m2,
                           std::span<const float> importance) {
  GatherConfig config;
  config.iteration = plan.iteration;
  config.refine = plan.refine;
  config.coarse_row = method.coarse_correction;
  config.close_rows = plan.close_rows;
  config.openness_rays = plan.openness_rays;
  config.flux_correction = plan.flux_correction;
  config.relaxation = plan.relaxation;
  config.extrapolation = plan.extrapolation;
  if (plan.sample) config.error_samples = error_samples(plan, area_m2);
  config.error_samples.importance = importance;
  config.refinement.link_tolerance = plan.link_tolerance;
  config.refinement.importance = importance;
  config.refinement.renew_far = plan.renew_far;
  config.refinement.max_depth = settings.max_depth;
  config.refinement.min_area_m2 = settings.min_area_m2;
  config.refinement.oracle = settings.oracle;
  config.refinement.visibility = settings.visibility;
  return config;
}

InitialClusters::InitialClusters(const Scene& scene, std::span<const Cluster> clusters,
                                 const Occluders& occluders, const CoarseUnknowns& unknowns,
                                 Basis basis, WorkCount& work)
    : scene_(scene),
      clusters_(clusters),
      occluders_(occluders),
      unknowns_(unknowns),
      basis_(basis),
      unreachable_(unreachable_polygons(scene, clusters, occluders, work)) {}

ClusterState InitialClusters::make(ClusterId id) const {
  ClusterState state(clusters_[id.index()], scene_, basis_, unknowns_.aggregates[id.index()]);
  for (std::uint32_t k = 0; k < state.patches().polygons(); ++k) {
    if (unreachable_[occluders_.global(id, k)] != 0) state.patches().mark_unreachable(k);
  }
  return state;
}

}  // namespace enfilade
