// Refinement oracles: the error of a link, and which of its sides to split if that is too large.
#pragma once

#include <memory>
#include <span>

#include "hierarchy/link.hpp"
#include "links/link_estimate.hpp"

namespace enfilade {

enum class OracleKind {
  error,                   ///< by the link's estimated error
  brightness_form_factor,  ///< BF: by the power that the link carries (Hanrahan, Salzman, Aupperle
                           ///< 1991)
};

class RefinementOracle {
 public:
  virtual ~RefinementOracle() = default;
  /// Returns the link's error in received power (m2 times irradiance, worst band) at the shooter's
  /// current light; a link is refined where this is above the tolerance.
  virtual double estimated_error(const Link& link, std::span<const float> transport,
                                 const PatchForest& receiver, const NodeLight& shooter) const = 0;
  /// True where the receiver is to be split, and not the shooter, of a link that is refined.
  virtual bool splits_receiver(const LinkSide& receiver, const LinkSide& shooter,
                               const LinkEstimate& estimate) const = 0;
};

std::unique_ptr<RefinementOracle> refinement_oracle(OracleKind kind);

}  // namespace enfilade
