#include "visibility/portal_search.hpp"

#include <algorithm>
#include <deque>

namespace enfilade {
namespace {

using SourceList = std::vector<const SourcePolygon*>;

// More source points than this are replaced by the corners of their box.
constexpr std::size_t most_points = 48;

class Search {
 public:
  Search(const DoorwayMap& doorways, std::span<const SourcePolygon> source, int max_passes,
         const std::function<void(const CellView&)>& visit, const IsHidden& is_hidden)
      : doorways_(doorways),
        slack_m_(doorways.slack_m()),
        max_passes_(max_passes),
        visit_(visit),
        is_hidden_(is_hidden),
        on_path_(doorways.portals(), 0),
        passes_(2 * doorways.portals(), 0) {
    for (const SourcePolygon& s : source) all_.push_back(&s);
  }

  const SourceList& all() const { return all_; }

  void enter(CellId cell, const SourceList& source, const HalfSpaces& within) {
    for (const Doorway& doorway : doorways_.of(cell)) {
      if (on_path_[doorway.portal] || passes_[doorway.number] > max_passes_) continue;
      if (outside(doorway.box, within, slack_m_)) continue;
      const Polygon window = clip_to(doorway.polygon, within, slack_m_);
      if (window.size() < 3) continue;
      if (passes_[doorway.number]++ < max_passes_) {
        pass(doorway, window, source, within);
      } else {
        // Any other sequence may follow, also through the portals that this one came by.
        std::vector<char> path(on_path_.size(), 0);
        std::vector<Window> windows;
        std::swap(path, on_path_);
        std::swap(windows, windows_);
        pass(doorway, doorway.polygon, all_, {});
        std::swap(windows, windows_);
        std::swap(path, on_path_);
      }
    }
  }

 private:
  void pass(const Doorway& doorway, const Polygon& window, const SourceList& source,
            const HalfSpaces& within) {
    std::deque<SourcePolygon> clipped;
    const SourceList facing = in_sight(source, window, doorway.plane, clipped);
    if (facing.empty()) return;
    if (is_hidden_ && is_hidden_({facing, windows_, window, doorway.plane})) return;
    HalfSpaces beyond = within;
    beyond.push_back({doorway.plane.n, doorway.plane.d - slack_m_});
    add_penumbra(points_of(facing), window, doorway.plane.n, slack_m_, beyond);
    visit_({doorway.leads_to, window, beyond});
    on_path_[doorway.portal] = 1;
    windows_.push_back({window, doorway.plane.n});
    enter(doorway.leads_to, facing, beyond);
    windows_.pop_back();
    on_path_[doorway.portal] = 0;
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
    if (points.size() <= most_points) return points;
    const std::array<Vec3, 8> corners = box.corners();
    return {corners.begin(), corners.end()};
  }

  const DoorwayMap& doorways_;
  double slack_m_;
  int max_passes_;
  const std::function<void(const CellView&)>& visit_;
  const IsHidden& is_hidden_;
  SourceList all_;
  std::vector<char> on_path_;
  std::vector<int> passes_;      ///< by doorway
  std::vector<Window> windows_;  ///< passed on the way here
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

void search_portals(const DoorwayMap& doorways, CellId start, std::span<const SourcePolygon> source,
                    int max_passes, const std::function<void(const CellView&)>& visit,
                    const IsHidden& is_hidden) {
  Search search(doorways, source, max_passes, visit, is_hidden);
  search.enter(start, search.all(), {});
}

}  // namespace enfilade
