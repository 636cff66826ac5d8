// G_cluster: every cluster looks out through its cell's portals; a pair is kept where each side
// sees the other.
#include <algorithm>
#include <optional>

#include "visibility/cell_parts.hpp"
#include "visibility/cluster_graph.hpp"
#include "visibility/facing.hpp"
#include "visibility/portal_search.hpp"

namespace enfilade {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

constexpr double portals_share = 0.3;  // of the time, about: for the progress that is reported

class ClusterVisibility {
 public:
  ClusterVisibility(const CellComplex& complex, std::span<const Cluster> clusters,
                    const VisibilityConfig& config, const Occlusion* occlusion)
      : config_(config),
        doorways_(complex),
        in_cell_(complex.cells().size()),
        seen_by_(clusters.size(), 0xFFFFFFFFu) {
    if (occlusion != nullptr) {
      is_hidden_ = [occlusion](const WindowView& view) { return occlusion->is_hidden(view); };
    }
    std::uint32_t number = 0;
    for (std::uint32_t i = 0; i < clusters.size(); ++i) {
      parts_.push_back(parts_by_cell(complex, clusters[i], number));
      number += static_cast<std::uint32_t>(clusters[i].polygons.size());
      for (std::uint32_t k = 0; k < parts_[i].size(); ++k) {
        in_cell_[parts_[i][k].cell.index()].push_back({i, k});
      }
    }
  }

  std::vector<Pair> pairs(const Progress& progress) {
    std::vector<Pair> seen;  // (source, cluster in view), for different cells
    std::vector<Pair> result;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      if (i % 64 == 0) {
        report_progress(
            progress, "visibility",
            portals_share * static_cast<double>(i) / static_cast<double>(parts_.size()));
      }
      for (const CellPart& part : parts_[i]) {
        add_same_cell(i, part, result);
        add_other_cells(i, part, seen);
      }
    }
    keep_mutual(seen, result);
    return result;
  }

 private:
  struct Member {
    std::uint32_t cluster, part;
  };

  // Each direction is conservative by itself, so that a pair seen in one direction alone is hidden.
  void keep_mutual(std::vector<Pair>& seen, std::vector<Pair>& result) const {
    std::sort(seen.begin(), seen.end());
    for (const auto& [a, b] : seen) {
      if (a < b && std::binary_search(seen.begin(), seen.end(), Pair(b, a)) &&
          face_each_other(parts_[a][0], parts_[b][0])) {
        result.emplace_back(a, b);
      }
    }
  }

  // A cluster's first part has all of its polygons.
  bool face_each_other(const CellPart& a, const CellPart& b) const {
    return enfilade::face_each_other(a.polygons, a.box, b.polygons, b.box,
                                     rounding_m(doorways_.slack_m()));
  }

  void add_same_cell(std::uint32_t i, const CellPart& part, std::vector<Pair>& result) const {
    for (const Member& m : in_cell_[part.cell.index()]) {
      const CellPart& other = parts_[m.cluster][m.part];
      if (m.cluster > i && face_each_other(part, other)) {
        result.emplace_back(i, m.cluster);
      }
    }
  }

  void add_other_cells(std::uint32_t i, const CellPart& part, std::vector<Pair>& seen) {
    const auto visit = [&](const CellView& view) {
      if (view.cell == part.cell) return;  // pairs within a cell are found by add_same_cell
      for (const Member& m : in_cell_[view.cell.index()]) {
        if (m.cluster == i || seen_by_[m.cluster] == i) continue;
        if (!in_view(parts_[m.cluster][m.part], view)) continue;
        seen_by_[m.cluster] = i;
        seen.emplace_back(i, m.cluster);
      }
    };
    search_portals(doorways_, part.cell, part.polygons, config_.max_passes, visit, is_hidden_);
  }

  // Does a polygon of the part lie within the view and face the window?
  bool in_view(const CellPart& part, const CellView& view) const {
    const double slack_m = doorways_.slack_m();
    if (outside(part.box, view.within, slack_m)) return false;
    return std::any_of(part.polygons.begin(), part.polygons.end(), [&](const SourcePolygon& q) {
      return any_in_front(view.window, q.plane, -slack_m) &&
             !outside(q.polygon, view.within, slack_m);
    });
  }

  VisibilityConfig config_;
  DoorwayMap doorways_;
  IsHidden is_hidden_;
  std::vector<std::vector<Member>> in_cell_;
  std::vector<std::vector<CellPart>> parts_;
  std::vector<std::uint32_t> seen_by_;  ///< the last cluster that saw this one
};

// Tries the pairs that are left after the windows, one by one, and drops those proved hidden.
void drop_hidden(std::vector<Pair>& pairs, const Occlusion& occlusion,
                 const OcclusionConfig& config, const Progress& progress) {
  const std::size_t share = config.all_parts / std::max<std::size_t>(pairs.size(), 1);
  if (share < static_cast<std::size_t>(config.min_parts)) return;
  const int parts = static_cast<int>(
      std::min<std::size_t>(share, static_cast<std::size_t>(std::max(config.max_parts, 0))));
  std::size_t done = 0;
  std::erase_if(pairs, [&](const Pair& pair) {
    if (done++ % 1024 == 0) {
      const double all = static_cast<double>(pairs.size());
      report_progress(progress, "visibility",
                      portals_share + (1.0 - portals_share) * static_cast<double>(done) / all);
    }
    return occlusion.between(pair.first, pair.second, parts) == Sight::hidden;
  });
}

}  // namespace

ClusterGraph visible_clusters(const CellComplex& complex, std::span<const Cluster> clusters,
                              const Progress& progress, const VisibilityConfig& config) {
  std::optional<Occlusion> occlusion;
  if (config.prove_hidden) occlusion.emplace(clusters, complex.tolerance_m(), config.occlusion);
  const Occlusion* used = occlusion ? &*occlusion : nullptr;
  std::vector<Pair> pairs = ClusterVisibility(complex, clusters, config, used).pairs(progress);
  if (used != nullptr) drop_hidden(pairs, *used, config.occlusion, progress);
  report_progress(progress, "visibility", 1.0);
  return {clusters.size(), std::move(pairs)};
}

}  // namespace enfilade
