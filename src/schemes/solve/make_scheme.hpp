// The one place where a parallel scheme is chosen.
#pragma once

#include <memory>
#include <vector>

#include "schemes/protocol/parallel_scheme.hpp"
#include "schemes/solve/solve.hpp"
#include "store/cluster_store.hpp"
#include "tour/tour.hpp"

namespace enfilade {

/// The parts of a scheme. All must outlive it.
struct SchemeParts {
  const SolveConfig& config;
  const Prepared& prepared;
  const std::vector<ClusterId>& own;  ///< clusters that this rank is assigned
  const VisibilityCost& cost;         ///< OVG's edge costs
  ClusterStore& store;
  Communicator& communicator;
  Machine& machine;
};

/// Makes this rank's object of config.scheme. One rank alone runs the paper's scheme, since a
/// master needs slaves.
std::unique_ptr<ParallelScheme> make_scheme(const SchemeParts& parts);

}  // namespace enfilade
