// The estimate of a link: transport coefficients, visibility included, and their errors.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/work_count.hpp"
#include "links/link_side.hpp"
#include "links/link_visibility.hpp"

namespace enfilade {

/// The outcome for one pair. Errors are received power (m2 times irradiance) per unit of the
/// shooter's light.
struct LinkEstimate {
  std::array<float, 9>
      transport{};              ///< receiver term by shooter term; group receiver: {E, direction}
  std::vector<double> tint{};   ///< of what passes panes, per band (LinkSet::add)
  double receiver_error = 0.0;  ///< from variation over the receiver that the fit leaves out
  double shooter_error = 0.0;   ///< from the uncertainty of the visible share
  double variation = 0.0;       ///< error per unit of the shooter's variation
  bool invisible = false;       ///< certain: no light can arrive
  bool sampled = false;         ///< by random rays
};

/// Form factors from points of a receiving patch to the whole shooter, as if nothing stood between;
/// from a light, irradiance per unit of mean intensity (1/m2).
struct PointFactors {
  std::array<double, 4> at{};  ///< at PatchShape::quadrature
  double mean = 0.0;           ///< of these four
  double center = 0.0;
  double rim = 0.0;  ///< largest near the corners; 0 where the inner points suffice (not evaluated)
  double total = -1.0;  ///< the exact mean over the patch, where it is known; else below 0
  double spread = 0.0;  ///< of a light's part: mean error of its points (LightKernel::spread)
  double unfit = 0.0;  ///< mean misfit of the affine fit at the corners: of a beam, of close planes
};

/// Evaluates links of one receiving cluster. Counts its work; keeps scratch memory between calls.
class LinkEstimator {
 public:
  LinkEstimator(const Occluders& occluders, VisibilityMethod method, WorkCount& work)
      : occluders_(&occluders), visibility_(occluders, method, work), work_(&work) {}

  using Between = LinkVisibility::Between;
  /// Evaluates the link between the two sides. `tolerance`: received power below which an error
  /// does not matter; it decides how many rays are cast. `among`: `between` of a link whose sides
  /// contain these two.
  LinkEstimate evaluate(const LinkSide& receiver, const LinkSide& shooter, double tolerance,
                        const Between& among);
  /// Returns the link that was evaluated last, whose transport is kept. Where rays
  /// were drawn it is evaluated once more with others: a link whose rays happened to show little is
  /// kept sooner than one whose rays show much, which is refined and drawn anew; so the rays that
  /// decided would carry too little light.
  LinkEstimate kept(const LinkSide& receiver, const LinkSide& shooter, double tolerance,
                    const Between& among, const LinkEstimate& decided);
  /// Returns the polygons between the sides of the link that was evaluated last.
  Between between() const { return visibility_.between(); }
  /// Returns an upper bound of the received power by distance and size alone, as if all of the
  /// shooter sent its mean radiosity; from a far node also by what portals let pass of the light of
  /// its brightest cell's mean.
  static double power_bound(const LinkSide& receiver, const LinkSide& shooter);
  /// The same per unit of the shooter's light (m2).
  static double factor_bound(const LinkSide& receiver, const LinkSide& shooter);
  /// True where the planes alone prove that no front side of one faces a front side of the other.
  static bool faces_away(const LinkSide& receiver, const LinkSide& shooter);

 private:
  LinkEstimate evaluate_patch(const LinkSide& receiver, const LinkSide& shooter, double tolerance);
  LinkEstimate evaluate_group(const LinkSide& receiver, const LinkSide& shooter);
  LinkEstimate evaluate_far(const LinkSide& receiver, const LinkSide& shooter, double tolerance);
  double seen_by_group(const LinkSide& receiver, const LinkSide& shooter,
                       std::span<const double> facing, double facing_m2, TintSum& tint);
  PointFactors point_factors(const LinkSide& receiver, const LinkSide& shooter);
  double factor_at(const Vec3& x, const Vec3& n, const LinkSide& shooter,
                   std::span<double> per_polygon);
  void clear_group_factors(const LinkSide& shooter);

  const Occluders* occluders_;
  LinkVisibility visibility_;
  std::uint64_t draw_ = 0;  ///< added to the seeds of rays
  WorkCount* work_;
  std::vector<double> group_factors_;  ///< per polygon of a shooting group, else empty
  Polygon polygon_;                    ///< scratch
};

}  // namespace enfilade
