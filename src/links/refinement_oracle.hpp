// Oracles of refinement: whether a link is good enough, and which of its sides to split if not.
#pragma once

#include <memory>
#include <span>

#include "hierarchy/link.hpp"
#include "links/link_estimate.hpp"

namespace enfilade {

enum class OracleKind {
  error,                   ///< by what the estimate says may be wrong with the link
  brightness_form_factor,  ///< BF: by the power that it carries (Hanrahan, Salzman, Aupperle 1991)
};

class RefinementOracle {
 public:
  virtual ~RefinementOracle() = default;
  /// In received power (m2 times irradiance, worst band) at today's light of the shooter; a link is
  /// refined where it is above the tolerance.
  virtual double estimated_error(const Link& link, std::span<const float> transport,
                                 const PatchForest& receiver, const NodeLight& shooter) const = 0;
  virtual bool splits_receiver(const LinkSide& receiver, const LinkSide& shooter,
                               const LinkEstimate& estimate) const = 0;
};

std::unique_ptr<RefinementOracle> refinement_oracle(OracleKind kind);

}  // namespace enfilade
