// The search keeps its own stack: sequences may be longer than the call stack is deep.
#include "visibility/portal_search.hpp"

#include <algorithm>
#include <deque>

namespace enfilade {
namespace {

using SourceList = std::vector<const SourcePolygon*>;

// The points of a source, if more than this, are replaced by the corners of their box.
constexpr std::size_t most_window_points = 48;

/// A sequence of portals: what lines through it pass, and where they lie beyond its last window.
struct Path {
  std::vector<Window> windows;
  HalfSpaces within;
};

/// A cell that the search has entered. Its doorways are tried in their order; then the search goes
/// back to the cell that it came from.
struct Step {
  CellId cell;
  SourceList source;                ///< the polygons that the last window faces, cut there
  std::deque<SourcePolygon> cut{};  ///< owns those of `source` that were cut: addresses stay
  std::size_t next_doorway = 0;
  std::uint32_t portal = no_portal;  ///< by which the cell was entered
  std::uint32_t path_before = 0;     ///< the path that the portal was on until then, 0 = none
  std::size_t spaces_before = 0;     ///< half spaces of the path without this step
  bool begins_path = false;          ///< a path of its own, dropped with this step
  static constexpr std::uint32_t no_portal = 0xFFFFFFFFu;
};

/// Depth-first search with a stack of its own: in a building whose walls have many layers a
/// search gets thousands of steps deep, at most one for each pass of a doorway.
class Search {
 public:
  Search(const DoorwayMap& doorways, std::span<const SourcePolygon> source, int max_passes,
         const std::function<void(const CellView&)>& visit, const IsHidden& is_hidden)
      : doorways_(doorways),
        slack_m_(doorways.slack_m()),
        max_passes_(max_passes),
        visit_(visit),
        is_hidden_(is_hidden),
        path_of_portal_(doorways.portals(), 0),
        passes_(2 * doorways.portals(), 0) {
    for (const SourcePolygon& s : source) all_.push_back(&s);
  }

  bool run(CellId start, std::uint64_t most_doorways) {
    paths_.emplace_back();
    steps_.push_back({start, all_});
    std::uint64_t tried = 0;
    while (!steps_.empty()) {
      Step& here = steps_.back();
      const std::span<const Doorway> doorways = doorways_.of(here.cell);
      if (here.next_doorway < doorways.size()) {
        if (tried++ >= most_doorways) return false;
        try_doorway(doorways[here.next_doorway++]);
      } else {
        go_back();
      }
    }
    return true;
  }

 private:
  void try_doorway(const Doorway& doorway) {
    if (path_of_portal_[doorway.portal] == paths_.size()) return;
    if (passes_[doorway.number] > max_passes_) return;
    const HalfSpaces& within = paths_.back().within;
    if (outside(doorway.box, within, slack_m_)) return;
    Polygon window = clip_to(doorway.polygon, within, slack_m_);
    if (window.size() < 3) return;
    if (passes_[doorway.number]++ < max_passes_) {
      pass(doorway, window, steps_.back().source, false);
    } else {
      // Any other sequence may follow, also through the portals that this one came by.
      paths_.emplace_back();
      if (!pass(doorway, doorway.polygon, all_, true)) paths_.pop_back();
    }
  }

  /// Enters the cell beyond the doorway; false where nothing of the source sees through the window.
  bool pass(const Doorway& doorway, const Polygon& window, const SourceList& source,
            bool begins_path) {
    Step step;
    step.cell = doorway.leads_to;
    step.source = in_sight(source, window, doorway.plane, step.cut);
    if (step.source.empty()) return false;
    Path& path = paths_.back();
    if (is_hidden_ && is_hidden_({step.source, path.windows, window, doorway.plane})) return false;
    step.spaces_before = path.within.size();
    path.within.push_back({doorway.plane.n, doorway.plane.d - slack_m_});
    add_penumbra(points_of(step.source), window, doorway.plane.n, slack_m_, path.within);
    visit_({doorway.leads_to, window, path.within});
    path.windows.push_back({window, doorway.plane.n});
    step.portal = doorway.portal;
    step.path_before = path_of_portal_[doorway.portal];
    step.begins_path = begins_path;
    path_of_portal_[doorway.portal] = static_cast<std::uint32_t>(paths_.size());
    steps_.push_back(std::move(step));
    return true;
  }

  void go_back() {
    const Step& last = steps_.back();
    if (last.begins_path) {
      paths_.pop_back();
    } else if (last.portal != Step::no_portal) {
      Path& path = paths_.back();
      path.windows.pop_back();
      path.within.resize(last.spaces_before);
    }
    if (last.portal != Step::no_portal) path_of_portal_[last.portal] = last.path_before;
    steps_.pop_back();
  }

  // The source polygons that have the window before them and lie on this side of it, cut there.
  SourceList in_sight(const SourceList& source, const Polygon& window, const Plane& plane,
                      std::deque<SourcePolygon>& clipped) const {
    SourceList result;
    for (const SourcePolygon* s : source) {
      const bool before = std::any_of(window.begin(), window.end(), [&](const Vec3& p) {
        return s->plane.signed_distance(p) > -slack_m_;
      });
      if (!before) continue;
      const Plane limit{plane.n, plane.d + slack_m_};
      const auto beyond = std::count_if(s->polygon.begin(), s->polygon.end(), [&](const Vec3& p) {
        return limit.signed_distance(p) > 0.0;
      });
      if (beyond == 0) {
        result.push_back(s);
      } else if (static_cast<std::size_t>(beyond) < s->polygon.size()) {
        SourcePolygon& near = clipped.emplace_back(*s);
        clip_behind(near.polygon, limit, 0.0);
        if (!near.polygon.empty()) result.push_back(&near);
      }
    }
    return result;
  }

  static std::vector<Vec3> points_of(const SourceList& source) {
    std::vector<Vec3> points;
    Box box;
    for (const SourcePolygon* s : source) {
      points.insert(points.end(), s->polygon.begin(), s->polygon.end());
      box.add(bounds(s->polygon));
    }
    if (points.size() <= most_window_points) return points;
    const std::array<Vec3, 8> corners = box.corners();
    return {corners.begin(), corners.end()};
  }

  const DoorwayMap& doorways_;
  double slack_m_;
  int max_passes_;
  const std::function<void(const CellView&)>& visit_;
  const IsHidden& is_hidden_;
  SourceList all_;
  std::vector<Path> paths_;                    ///< the last one is followed
  std::deque<Step> steps_;                     ///< no step moves: `source` points into `cut`
  std::vector<std::uint32_t> path_of_portal_;  ///< the last path that passes it, from 1; 0 = none
  std::vector<int> passes_;                    ///< by doorway
};

}  // namespace

DoorwayMap::DoorwayMap(const CellComplex& complex)
    : doorways_(complex.cells().size()),
      portals_(complex.portals().size()),
      slack_m_(complex.tolerance_m()) {
  for (const Portal& portal : complex.portals()) {
    const Plane plane = plane_of(portal.polygon);
    const Plane reverse{-plane.n, -plane.d};
    const Box box = bounds(portal.polygon);
    // The polygon faces cell a, which lies in front of it.
    const std::uint32_t k = portal.id.value;
    doorways_[portal.b.index()].push_back({k, 2 * k, portal.a, portal.polygon, plane, box});
    doorways_[portal.a.index()].push_back({k, 2 * k + 1, portal.b, portal.polygon, reverse, box});
  }
}

bool search_portals(const DoorwayMap& doorways, CellId start, std::span<const SourcePolygon> source,
                    int max_passes, const std::function<void(const CellView&)>& visit,
                    const IsHidden& is_hidden, std::uint64_t most_doorways) {
  return Search(doorways, source, max_passes, visit, is_hidden).run(start, most_doorways);
}

}  // namespace enfilade
