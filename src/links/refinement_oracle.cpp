#include "links/refinement_oracle.hpp"

#include "hierarchy/link.hpp"

namespace enfilade {
namespace {

/// What the kernel, visibility and the shooter's light may vary by over the link.
class ErrorOracle final : public RefinementOracle {
 public:
  double estimated_error(const Link& link, std::span<const float> /*transport*/,
                         const PatchForest& /*receiver*/, const NodeLight& shooter) const override {
    return link.error * shooter.light + link.variation * shooter.variation;
  }

  /// The side that dominates; where visibility alone is in uncertainty, the larger one.
  bool splits_receiver(const LinkSide& receiver, const LinkSide& shooter,
                       const LinkEstimate& estimate) const override {
    const bool shooter_is_larger = shooter.radius > receiver.radius;
    const double variation_error = estimate.variation * shooter.variation;
    const double receiver_error = estimate.receiver_error * shooter.light;
    const double shooter_error = estimate.shooter_error * shooter.light + variation_error;
    if (receiver.is_group()) return !(shooter.is_group() && shooter_is_larger);
    if (shooter.is_group() && receiver_error < shooter_error) return false;
    return receiver_error > shooter_error ||
           (receiver_error > 0.25 * shooter_error && !shooter_is_larger) ||
           (variation_error < 0.5 * shooter_error && !shooter_is_larger);
  }
};

/// Brightness times form factor times area: what matters much is cut finely, whether it varies or
/// not.
class BrightnessOracle final : public RefinementOracle {
 public:
  double estimated_error(const Link& link, std::span<const float> transport,
                         const PatchForest& receiver, const NodeLight& shooter) const override {
    return area_factor(receiver, link, transport) * shooter.light;
  }

  bool splits_receiver(const LinkSide& receiver, const LinkSide& shooter,
                       const LinkEstimate& /*estimate*/) const override {
    return receiver.radius >= shooter.radius;
  }
};

}  // namespace

std::unique_ptr<RefinementOracle> refinement_oracle(OracleKind kind) {
  if (kind == OracleKind::error) return std::make_unique<ErrorOracle>();
  return std::make_unique<BrightnessOracle>();
}

}  // namespace enfilade
