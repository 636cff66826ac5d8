// What one link carries and how wrong that may be: transport, visibility, and an error for either
// side.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/work_count.hpp"
#include "geometry/visible_parts.hpp"
#include "hierarchy/cluster_state.hpp"
#include "occluders/occluders.hpp"

namespace enfilade {

/// What a node sends.
struct NodeLight {
  double light = 0.0;      ///< mean radiosity, worst band (a light's intensity)
  double variation = 0.0;  ///< RMS variation around the mean, worst band

  static NodeLight of(const PatchForest& forest, PatchId id);
  static NodeLight of(const PointLight& light);
};

/// A node of a hierarchy as one side of a link. A patch that its owner has not made is cut out of
/// its ancestor here, with the ancestor's light.
struct LinkSide : NodeLight {
  const PatchForest* forest = nullptr;  ///< null: a point light
  ClusterId cluster;
  PatchId id;
  PatchShape shape;  ///< of a patch
  Polygon corners;   ///< of a patch in space; of a light its place
  Vec3 center{0.0};
  double radius = 0.0;  ///< of a ball around the centre that holds it
  double area_m2 = 0.0;

  bool is_light() const { return forest == nullptr; }
  bool is_group() const { return forest != nullptr && id.is_group(); }
  bool is_patch() const { return forest != nullptr && !id.is_group(); }
  const PolygonFrame& frame() const { return forest->frames()[id.root]; }
  Plane plane() const { return {frame().n, glm::dot(frame().n, frame().origin)}; }
  const GroupNode& group() const { return forest->groups()[id.group()]; }
  /// A patch's part before the plane; the patch itself where all of it is.
  LinkSide before(const Plane& plane) const;
  bool same_node(const LinkSide& o) const { return cluster == o.cluster && id == o.id; }

  /// Of whatever lots are drawn for the pair, the same wherever it is evaluated.
  static std::uint64_t seed_of(const LinkSide& a, const LinkSide& b);
  static LinkSide of(const PatchForest& forest, ClusterId cluster, PatchId id);
  static LinkSide of(const PointLight& light, std::uint32_t number);
};

/// The outcome for one pair. Errors are received power (m2 times irradiance) per unit of the
/// shooter's light.
struct LinkEstimate {
  std::array<float, 9>
      transport{};              ///< receiver term by shooter term; group receiver: {E, direction}
  double receiver_error = 0.0;  ///< from what varies over the receiver
  double shooter_error = 0.0;   ///< from visibility that varies over the shooter
  double variation = 0.0;       ///< per unit of the shooter's variation
  bool invisible = false;       ///< certain: nothing can ever arrive
};

enum class VisibilityMethod {
  exact,  ///< cut exactly against few occluders; against many by rays and proofs
  rays,   ///< rays alone
};

/// Evaluates links of one receiving cluster. Counts its work; keeps scratch memory between calls.
class LinkEstimator {
 public:
  LinkEstimator(const Occluders& occluders, VisibilityMethod method, WorkCount& work)
      : occluders_(&occluders), method_(method), work_(&work) {}

  /// All polygons between the two sides of a link; null where they were not looked for, or are too
  /// many.
  using Between = std::shared_ptr<const std::vector<std::uint32_t>>;

  /// `tolerance`: received power below which an error does not matter; it decides how many rays are
  /// cast. `among`: `between` of a link whose parts the two sides are.
  LinkEstimate evaluate(const LinkSide& receiver, const LinkSide& shooter, double tolerance,
                        const Between& among);
  /// Of the link that was evaluated last.
  Between between() const;
  /// Largest power that could arrive, by distance and size alone.
  static double power_bound(const LinkSide& receiver, const LinkSide& shooter);
  /// Certain from the planes alone that no front side of one faces a front side of the other.
  static bool faces_away(const LinkSide& receiver, const LinkSide& shooter);

 private:
  struct Visibility {
    std::array<double, 4> at{1.0, 1.0, 1.0, 1.0};  ///< share of the shooter seen from each quarter
    double center = 1.0;                           ///< and from the centre, or from all over
    double within = 0.0;                           ///< uncertainty of the mean, as a share
    double unfit = 0.0;  ///< mean factor that varies otherwise than the four points foretell
    /// Where a point is known to see only a part, the middle of that part: from the shooter's
    /// centroid, in its polygon's frame.
    std::array<bool, 4> partial{};
    std::array<Vec2, 4> seen_from{};
    void fill(double share) {
      at.fill(share);
      center = share;
    }
  };
  LinkEstimate evaluate_patch(const LinkSide& receiver, const LinkSide& shooter, double tolerance);
  LinkEstimate evaluate_group(const LinkSide& receiver, const LinkSide& shooter);
  double factor_at(const Vec3& x, const Vec3& n, const LinkSide& shooter, double* per_polygon);
  Visibility visibility(const LinkSide& receiver, const LinkSide& shooter, double power,
                        double tolerance);
  Visibility by_rays(const LinkSide& receiver, const LinkSide& shooter, double power,
                     double tolerance);
  bool by_parts(const LinkSide& receiver, const LinkSide& shooter, Visibility& v);
  bool cut_parts(const Vec3& x, const LinkSide& shooter);
  bool find_between(const LinkSide& receiver, const LinkSide& shooter);
  double small_shadows(const LinkSide& receiver, const LinkSide& shooter);
  bool ray_open(const Vec3& x, std::uint32_t skip, const LinkSide& shooter, int quarter,
                class Random& random, std::uint32_t* blocker);

  const Occluders* occluders_;
  VisibilityMethod method_;
  WorkCount* work_;
  std::vector<double> weights_;  ///< per polygon of a shooting group
  Polygon polygon_;
  Between among_;
  std::vector<std::uint32_t> between_;  ///< occluders of the link at hand
  bool all_between_ = false;            ///< between_ has been looked for, and is complete
  VisibleParts parts_;
};

}  // namespace enfilade
