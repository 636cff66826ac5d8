// Visibility between the two sides of a link: exact against few occluders, by rays otherwise.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "base/work_count.hpp"
#include "geometry/visible_parts.hpp"
#include "links/link_side.hpp"
#include "occluders/occluders.hpp"
#include "occluders/pane_view.hpp"

namespace enfilade {

enum class VisibilityMethod {
  exact,  ///< exact against few occluders; against many by rays, and by proofs where rays agree
  rays,   ///< rays alone
};

/// How much a receiving patch sees of a shooter.
struct PairVisibility {
  std::array<double, 4> at{1.0, 1.0, 1.0, 1.0};  ///< share (0 .. 1) seen from each quarter
  double center = 1.0;       ///< share seen from the centre, or by rays from the whole patch
  double uncertainty = 0.0;  ///< of the mean visible share, as a share of the shooter
  /// Mean hidden form factor that the four points do not predict.
  double unfit = 0.0;
  bool sampled = false;  ///< by random rays
  TintSum tint{};        ///< of what passes panes
  /// Exact visibility only. partial[k]: point k sees only a part of the shooter. seen_from[k]: the
  /// centroid of this part's light, relative to the shooter's centroid, in the frame of the
  /// shooter's polygon.
  std::array<bool, 4> partial{};
  std::array<Vec2, 4> seen_from{};

  void fill(double share) {
    at.fill(share);
    center = share;
  }
};

/// Evaluates the visibility of pairs, one after the other. Counts its work; keeps scratch memory.
class LinkVisibility {
 public:
  LinkVisibility(const Occluders& occluders, VisibilityMethod method, WorkCount& work)
      : occluders_(&occluders), method_(method), work_(&work) {}

  /// All polygons between the two sides of a link; null where they were not searched for, or are
  /// too many.
  using Between = std::shared_ptr<const std::vector<std::uint32_t>>;

  /// Begins a pair. `among`: `between` of a pair whose sides contain the new pair's, or null.
  /// `draw`: pairs of the same sides have other rays with another number.
  void begin(const Between& among, std::uint64_t draw) {
    among_ = among;
    draw_ = draw;
    all_between_ = false;
  }
  /// Returns the visibility of the shooter from a receiving patch. `group_factors`: form factor of
  /// each polygon of a shooting group. `power`: received power if all is visible; `tolerance`:
  /// power that does not matter.
  PairVisibility of(const LinkSide& receiver, const LinkSide& shooter,
                    std::span<const double> group_factors, double power, double tolerance);
  /// Casts a ray from x, on polygon `skip`, to a random point in a quarter (0 .. 3) of the shooter;
  /// returns what passes. Writes the polygon that is hit into `blocker` unless that is null.
  Passage ray(const Vec3& x, std::uint32_t skip, const LinkSide& shooter,
              std::span<const double> group_factors, int quarter, Random& random,
              std::uint32_t* blocker);
  /// Returns the polygons between the sides of the pair that was evaluated last.
  Between between() const;

 private:
  /// A ray's other end.
  struct Target {
    Vec3 place;
    std::uint32_t polygon;  ///< global number, or RayScene::no_polygon
  };
  /// How much of the shooter's form factor one point sees, and how much is hidden from it.
  struct PointCut {
    double seen = 0.0, hidden = 0.0;
    double share() const { return hidden > 0.0 ? seen / (seen + hidden) : 1.0; }
  };
  struct QuarterRays;

  Target target_on(const LinkSide& shooter, std::span<const double> group_factors, int quarter,
                   Random& random) const;
  PairVisibility by_rays(const LinkSide& receiver, const LinkSide& shooter,
                         std::span<const double> group_factors, double power, double tolerance);
  bool proven(const LinkSide& receiver, const LinkSide& shooter, bool open, std::uint32_t blocker);

  bool find_between(const LinkSide& receiver, const LinkSide& shooter);
  bool one_hides_all(const LinkSide& receiver, const LinkSide& shooter) const;
  std::optional<PairVisibility> by_parts(const LinkSide& receiver, const LinkSide& shooter);
  std::optional<double> unpredicted_at_corners(const LinkSide& receiver, const LinkSide& shooter,
                                               const std::array<double, 4>& hidden, PointCut& most);
  std::optional<PointCut> cut_at(const Vec3& x, const Vec3& n, const LinkSide& shooter,
                                 PointCut& most);
  bool cut_parts(const Vec3& x, const LinkSide& shooter);
  bool through_whole_panes(const LinkSide& receiver, const LinkSide& light, PairVisibility& v);
  double small_shadows(const LinkSide& receiver, const LinkSide& shooter);

  const Occluders* occluders_;
  VisibilityMethod method_;
  WorkCount* work_;
  Between among_;
  std::uint64_t draw_ = 0;
  std::vector<std::uint32_t> between_;  ///< occluders of the pair at hand
  bool all_between_ = false;            ///< between_ has been searched for, and is complete
  VisibleParts parts_;
  std::vector<std::uint32_t> panes_;  ///< of the pair at hand
  std::vector<DimmedPart> dimmed_;    ///< the visible parts as seen through them
};

}  // namespace enfilade
