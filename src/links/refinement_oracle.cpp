#include "links/refinement_oracle.hpp"

#include "hierarchy/link.hpp"

namespace enfilade {
namespace {

/// The receiver's error is comparable to the shooter's above this share of it.
constexpr double comparable = 0.25;
/// The shooter's error comes mostly from visibility where its variation makes less than this share.
constexpr double mostly_visibility = 0.5;

/// The link's estimated error: by the variation of kernel and visibility over the receiver, and of
/// visibility and radiosity over the shooter.
class ErrorOracle final : public RefinementOracle {
 public:
  double estimated_error(const Link& link, std::span<const float> /*transport*/,
                         const PatchForest& /*receiver*/, const NodeLight& shooter) const override {
    return link.error * shooter.light + link.variation * shooter.variation;
  }

  /// The side whose error dominates; where only visibility is uncertain, the larger side.
  bool splits_receiver(const LinkSide& receiver, const LinkSide& shooter,
                       const LinkEstimate& estimate) const override {
    const bool shooter_is_larger = shooter.radius > receiver.radius;
    const double variation_error = estimate.variation * shooter.variation;
    const double receiver_error = estimate.receiver_error * shooter.light;
    const double shooter_error = estimate.shooter_error * shooter.light + variation_error;
    const bool shoots_as_one = shooter.is_group() || shooter.is_far();
    if (receiver.is_group()) return !(shoots_as_one && shooter_is_larger);
    if (shooter.is_far() && (shooter_is_larger || receiver_error < shooter_error)) return false;
    if (shooter.is_group() && receiver_error < shooter_error) return false;
    return receiver_error > shooter_error ||
           (receiver_error > comparable * shooter_error && !shooter_is_larger) ||
           (variation_error < mostly_visibility * shooter_error && !shooter_is_larger);
  }
};

/// The power that the link carries: radiosity times form factor times area (Hanrahan, Salzman and
/// Aupperle 1991). Refines links of high power even where nothing varies over them.
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
