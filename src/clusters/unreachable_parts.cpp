// A binary tree of cuts for each piece; its leaves are reachable or unreachable as a whole.
#include "clusters/unreachable_parts.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "clusters/contact_segments.hpp"
#include "clusters/light_walk.hpp"
#include "geometry/convex.hpp"
#include "geometry/sampling.hpp"

namespace enfilade {
namespace {

constexpr int points_of_part = 8;  // walks of a part start from this many stratified points
/// Where a part seems dark, a contact in it has this part of the walks on either side, at three
/// points: of walks from places of the duplex that light reaches, two of three find it.
constexpr int few_walks = 16;
/// Of the steps that are left, a piece may use as many equal shares as it has contacts, or this
/// many.
constexpr std::size_t least_shares = 16;
constexpr double inside_share = 0.96;  // of the way from a part's centroid to such a point

/// A part of a piece, and its halves where it is cut along a contact; a leaf has no children (0).
struct Node {
  Polygon polygon;
  std::vector<Segment> segments;  ///< inside the polygon, longest first
  std::size_t front = 0, back = 0;
  bool unreachable = false;
};

struct Part {
  Polygon polygon;
  bool unreachable;
};

/// Returns the parts of the segments in front of the plane, longest first.
std::vector<Segment> in_front(const std::vector<Segment>& segments, const Plane& plane,
                              double tolerance_m, double min_length_m) {
  std::vector<Segment> kept;
  for (Segment s : segments) {
    if (clip_front(s, plane, tolerance_m) && s.length_m() >= min_length_m) kept.push_back(s);
  }
  std::stable_sort(kept.begin(), kept.end(),
                   [](const Segment& s, const Segment& t) { return s.length_m() > t.length_m(); });
  return kept;
}

/// Cuts one piece into reachable and unreachable parts.
class PieceCut {
 public:
  PieceCut(std::size_t piece, const Polygon& polygon, std::vector<Segment> segments,
           LightWalk& walk, const UnreachableConfig& config, double tolerance_m,
           double min_length_m, std::uint64_t last_step, Random random)
      : piece_(piece),
        n_(normal(polygon)),
        walk_(walk),
        config_(config),
        tolerance_m_(tolerance_m),
        min_length_m_(min_length_m),
        last_step_(last_step),
        random_(random) {
    add(polygon, std::move(segments));
  }

  std::vector<Part> parts() {
    cut();
    join_alike();
    std::vector<Part> found;
    collect(0, found);
    rejoin(found);
    return found;
  }

 private:
  void add(Polygon polygon, std::vector<Segment> segments) {
    const bool unreachable = is_unreachable(polygon);
    nodes_.push_back({std::move(polygon), std::move(segments), 0, 0, unreachable});
  }

  /// Longest contact first, over all leaves, until no contact parts reachable ground from
  /// unreachable.
  void cut() {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry> longest;
    const auto push = [&](std::size_t i) {
      if (!nodes_[i].segments.empty()) longest.push({nodes_[i].segments[0].length_m(), i});
    };
    push(0);
    for (std::size_t leaves = 1;
         !longest.empty() && leaves < config_.max_parts && walk_.steps() < last_step_;) {
      const std::size_t i = longest.top().second;
      longest.pop();
      leaves += halve(i) ? 1 : 0;
      if (nodes_[i].front == 0) {
        push(i);
      } else {
        push(nodes_[i].front);
        push(nodes_[i].back);
      }
    }
  }

  /// Cuts a node along its longest contact; false where the contact is no border between reachable
  /// and unreachable ground: then the contact is dropped.
  bool halve(std::size_t i) {
    const Segment s = nodes_[i].segments.front();
    const Vec3 across = glm::normalize(glm::cross(n_, s.b - s.a));
    std::pair<Polygon, Polygon> halves;
    const Plane plane{across, glm::dot(across, s.a)};
    const int walks = std::max(1, config_.walks / (nodes_[i].unreachable ? few_walks : 2));
    const bool border = parts_reachable_ground(s, across, walks);
    if (border) halves = split(nodes_[i].polygon, plane, tolerance_m_);
    if (halves.first.size() < 3 || halves.second.size() < 3) {
      nodes_[i].segments.erase(nodes_[i].segments.begin());
      return false;
    }
    const std::vector<Segment> segments = std::move(nodes_[i].segments);
    nodes_[i].front = nodes_.size();
    nodes_[i].back = nodes_.size() + 1;
    add(std::move(halves.first), in_front(segments, plane, tolerance_m_, min_length_m_));
    add(std::move(halves.second), in_front(segments, plane.flipped(), tolerance_m_, min_length_m_));
    return true;
  }

  /// Is light found on one side of the contact and not on the other, at one of three points?
  bool parts_reachable_ground(const Segment& s, const Vec3& across, int walks) {
    for (const double t : {0.5, 0.15, 0.85}) {
      const Vec3 p = s.a + t * (s.b - s.a);
      const Vec3 aside = 4.0 * tolerance_m_ * across;
      if (walk_.finds_light(piece_, p + aside, n_, walks, random_) !=
          walk_.finds_light(piece_, p - aside, n_, walks, random_)) {
        return true;
      }
    }
    return false;
  }

  /// Walks start from points stratified by area over the triangles of a fan, a little inside the
  /// part.
  bool is_unreachable(const Polygon& polygon) {
    const double area = area_m2(polygon);
    const Vec3 c = centroid(polygon);
    std::size_t k = 2;
    double before = 0.0;
    const auto triangle = [&](std::size_t j) {
      return 0.5 * glm::length(glm::cross(polygon[j - 1] - polygon[0], polygon[j] - polygon[0]));
    };
    for (int i = 0; i < points_of_part; ++i) {
      const double target = area * (i + 0.5) / points_of_part;
      while (k + 1 < polygon.size() && before + triangle(k) < target) before += triangle(k++);
      const double r1 = random_.uniform(), r2 = random_.uniform();
      const Vec3 p = point_in_triangle(polygon[0], polygon[k - 1], polygon[k], r1, r2);
      if (walk_.steps() >= last_step_) return false;
      const int walks = std::max(1, config_.walks / points_of_part);
      if (walk_.finds_light(piece_, c + inside_share * (p - c), n_, walks, random_)) return false;
    }
    return true;
  }

  /// Two leaves of one node that are alike become whole again.
  void join_alike() {
    for (std::size_t i = nodes_.size(); i-- > 0;) {
      Node& node = nodes_[i];
      if (node.front == 0) continue;
      const Node &a = nodes_[node.front], &b = nodes_[node.back];
      if (a.front == 0 && b.front == 0 && a.unreachable == b.unreachable) {
        node.unreachable = a.unreachable;
        node.front = node.back = 0;
      }
    }
  }

  void collect(std::size_t i, std::vector<Part>& found) {
    Node& node = nodes_[i];
    if (node.front == 0) {
      found.push_back({std::move(node.polygon), node.unreachable});
    } else {
      collect(node.front, found);
      collect(node.back, found);
    }
  }

  /// Joins two parts that are alike where their hull is no larger than their sum.
  void rejoin(std::vector<Part>& parts) const {
    for (bool joined = true; joined;) {
      joined = false;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        for (std::size_t j = i + 1; j < parts.size();) {
          if (join(parts[i], parts[j])) {
            parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
            joined = true;
          } else {
            ++j;
          }
        }
      }
    }
  }

  bool join(Part& a, const Part& b) const {
    if (a.unreachable != b.unreachable ||
        !bounds(a.polygon).overlaps(bounds(b.polygon), tolerance_m_)) {
      return false;
    }
    std::vector<Vec3> points(a.polygon);
    points.insert(points.end(), b.polygon.begin(), b.polygon.end());
    Polygon hull = convex_hull(std::move(points), n_);
    const double sum = area_m2(a.polygon) + area_m2(b.polygon);
    if (std::abs(area_m2(hull) - sum) > 1e-9 * sum) return false;
    a.polygon = std::move(hull);
    return true;
  }

  std::size_t piece_;
  Vec3 n_;
  LightWalk& walk_;
  const UnreachableConfig& config_;
  double tolerance_m_, min_length_m_;
  std::uint64_t last_step_;  ///< of the walks: then all that is left is taken to be reachable
  Random random_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<CellPiece> cut_unreachable_parts(const Scene& scene, std::span<const CellPiece> pieces,
                                             double tolerance_m, const UnreachableConfig& config) {
  Box box;
  std::vector<const Polygon*> polygons;
  for (const CellPiece& piece : pieces) {
    polygons.push_back(&piece.piece.polygon);
    box.add(bounds(piece.piece.polygon));
  }
  const double min_length_m = config.min_length_relative * box.diagonal();
  const ContactSegments contacts(polygons, tolerance_m, min_length_m);
  // Walks start clear of polygons that lie in the plane itself.
  LightWalk walk(scene, pieces, 2.0 * tolerance_m, config.max_bounces);
  const std::uint64_t most_steps = config.free_steps + config.steps_per_piece * pieces.size();
  std::vector<CellPiece> cut;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Piece& piece = pieces[i].piece;
    std::vector<Segment> segments = contacts.inside(i);
    const std::uint64_t left = most_steps - std::min(most_steps, walk.steps());
    const std::uint64_t steps =
        left / (pieces.size() - i) * std::max(least_shares, segments.size());
    PieceCut one(i, piece.polygon, std::move(segments), walk, config, tolerance_m, min_length_m,
                 walk.steps() + std::min(steps, left / 4),
                 Random(config.seed * 0x9E3779B97F4A7C15ull + i));
    std::vector<Part> parts = one.parts();
    if (std::all_of(parts.begin(), parts.end(), [](const Part& p) { return p.unreachable; }))
      walk.mark_dark(i);
    for (Part& part : parts) {
      cut.push_back({pieces[i].cell,
                     {piece.surface, std::move(part.polygon), piece.reversed},
                     part.unreachable});
    }
  }
  return cut;
}

}  // namespace enfilade
