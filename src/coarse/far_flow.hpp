// The power that flows by reflection from far shooters to the aggregates of one cluster: entries of
// the coarse system.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "coarse/coarse_row.hpp"
#include "far_field/building_light.hpp"

namespace enfilade {

/// How the power that a node of the building's tree reflects is divided among the unknowns of the
/// clusters below it; for one iteration.
class FarUnknowns {
 public:
  struct Parts {
    std::vector<std::uint32_t> unknown;  ///< ascending
    std::vector<double> share;           ///< of the reflected power, [part * bands + band]
  };
  /// All must outlive it.
  FarUnknowns(const BuildingLight& light, const CoarseUnknowns& unknowns)
      : light_(light), unknowns_(unknowns), parts_(light.tree().nodes().size()) {}

  std::size_t bands() const { return light_.bands(); }
  std::size_t count() const { return unknowns_.count; }
  const Parts& of(std::uint32_t node) const;

 private:
  Parts make(std::uint32_t node) const;

  const BuildingLight& light_;
  const CoarseUnknowns& unknowns_;
  mutable std::vector<std::unique_ptr<Parts>> parts_;  ///< by node, once it is asked
  mutable std::vector<double> sums_;  ///< scratch: [unknown * bands + band], zero between calls
};

/// Sums the links from far shooters to one receiving cluster.
class FarFlow {
 public:
  /// Both must outlive it.
  FarFlow(const PatchForest& receiver, const Aggregates& receiving)
      : receiver_(receiver), receiving_(receiving) {}
  /// Adds a link. `power`: reflected power per band that it brings to its receiver.
  void add(const Link& link, std::span<const float> transport, std::span<const double> power);
  CoarseRow::Far entries(const FarUnknowns& unknowns);

 private:
  const PatchForest& receiver_;
  const Aggregates& receiving_;
  /// The reflected power per band that one link brings.
  struct Part {
    std::uint32_t node, first;  ///< `first`: of its numbers in power_
  };
  std::vector<Part> parts_;
  std::vector<double> power_;  ///< [receiving aggregate * bands + band] of one part after the other
};

}  // namespace enfilade
