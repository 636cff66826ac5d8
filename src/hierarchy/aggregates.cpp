#include "hierarchy/aggregates.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <queue>

#include "base/error.hpp"

namespace enfilade {
namespace {

/// A path has at most 32 bits; a patch with a full path cannot be split.
constexpr int longest_path_bits = 32;

/// One lies on the way from the root to the other.
bool related(std::uint32_t a, std::uint32_t b) {
  const int deeper = std::bit_width(b) - std::bit_width(a);
  return deeper >= 0 ? (b >> deeper) == a : (a >> -deeper) == b;
}

/// A node of the hierarchy while the cut is made; the largest is split first.
struct CutNode {
  PatchId id;
  double area_m2;
  PatchShape shape;  ///< of a patch

  static CutNode of(const PatchForest& forest, PatchId id) {
    if (id.is_group()) return {id, forest.groups()[id.group()].area_m2, {}};
    const PatchShape& shape = forest.node(id.root).shape;
    return {id, shape.area_m2, shape};
  }
  bool operator<(const CutNode& o) const {
    return area_m2 != o.area_m2 ? area_m2 < o.area_m2 : id > o.id;
  }
};

/// Splits the largest node of the hierarchy until there are `most`.
std::vector<CutNode> cut_hierarchy(const PatchForest& forest, std::size_t most) {
  std::priority_queue<CutNode> parts;
  parts.push(CutNode::of(forest, forest.root()));
  std::vector<CutNode> whole;  // at the end of their paths
  while (!parts.empty() && parts.size() + whole.size() < most) {
    const CutNode largest = parts.top();
    parts.pop();
    if (largest.id.is_group()) {
      const GroupNode& group = forest.groups()[largest.id.group()];
      parts.push(CutNode::of(forest, group.left_id()));
      parts.push(CutNode::of(forest, group.right_id()));
    } else if (std::bit_width(largest.id.path) == longest_path_bits) {
      whole.push_back(largest);
    } else {
      auto halves = largest.shape.halves(largest.shape.cut(forest.frames()[largest.id.root].lines));
      const double areas[2] = {halves.first.area_m2, halves.second.area_m2};
      parts.push({largest.id.child(0), areas[0], std::move(halves.first)});
      parts.push({largest.id.child(1), areas[1], std::move(halves.second)});
    }
  }
  for (; !parts.empty(); parts.pop()) whole.push_back(parts.top());
  return whole;
}

/// Depth first: by the polygons' order, then along the paths, aligned to the left.
void sort_depth_first(const PatchForest& forest, std::vector<CutNode>& nodes) {
  std::vector<std::uint32_t> place(forest.polygons());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[forest.order()[i]] = i;
  const auto first_place = [&](PatchId id) {
    return id.is_group() ? forest.groups()[id.group()].begin : place[id.root];
  };
  const auto aligned = [](PatchId id) {
    return id.path << (longest_path_bits - std::bit_width(id.path));
  };
  std::sort(nodes.begin(), nodes.end(), [&](const CutNode& a, const CutNode& b) {
    return std::pair(first_place(a.id), aligned(a.id)) <
           std::pair(first_place(b.id), aligned(b.id));
  });
}

/// Irradiance of a cluster's leaves, summed up over each polygon within each aggregate (a leaf over
/// several aggregates counts for the first).
class LeafLight {
 public:
  LeafLight(const PatchForest& forest, const Aggregates& aggregates)
      : forest_(forest), aggregates_(aggregates) {
    for_each_leaf([&](std::size_t i) { add_to_mean(i); });
    for (auto& [name, part] : parts_) {
      for (double& mean : part.mean) mean = part.area_m2 > 0.0 ? mean / part.area_m2 : 0.0;
    }
    for_each_leaf([&](std::size_t i) { limit_uniform(i); });
  }

  struct Part {
    double area_m2 = 0.0;
    std::vector<double> mean;     ///< irradiance per band, by area
    std::vector<double> uniform;  ///< least irradiance of a leaf per mean, 0 .. 1, per band
  };
  const Part& of(const PatchNode& leaf) const { return parts_.at(name(leaf)); }

 private:
  using Name = std::pair<std::uint32_t, std::uint32_t>;  ///< polygon, first aggregate
  Name name(const PatchNode& leaf) const {
    return {leaf.id.root, aggregates_.of(forest_, leaf.id).begin};
  }
  double irradiance(std::size_t leaf, std::size_t band) const {
    return forest_.irradiance(leaf)[band * static_cast<std::size_t>(forest_.terms())];
  }
  template <class Visit>
  void for_each_leaf(Visit visit) const {
    for (std::size_t i = 0; i < forest_.size(); ++i) {
      if (forest_.node(i).leaf()) visit(i);
    }
  }
  void add_to_mean(std::size_t i) {
    const PatchNode& leaf = forest_.node(i);
    const auto bands = static_cast<std::size_t>(forest_.bands());
    Part& part = parts_[name(leaf)];
    part.mean.resize(bands, 0.0);
    part.uniform.resize(bands, 1.0);
    part.area_m2 += leaf.shape.area_m2;
    for (std::size_t b = 0; b < bands; ++b) part.mean[b] += leaf.shape.area_m2 * irradiance(i, b);
  }
  void limit_uniform(std::size_t i) {
    Part& part = parts_[name(forest_.node(i))];
    for (std::size_t b = 0; b < part.mean.size(); ++b) {
      const double mean = part.mean[b];
      const double least = mean > 0.0 ? irradiance(i, b) / mean : 0.0;
      part.uniform[b] = std::clamp(least, 0.0, part.uniform[b]);
    }
  }

  const PatchForest& forest_;
  const Aggregates& aggregates_;
  std::map<Name, Part> parts_;
};

}  // namespace

Aggregates::Aggregates(const PatchForest& forest, std::size_t most) {
  if (most < 2) return;
  std::vector<CutNode> nodes = cut_hierarchy(forest, most);
  sort_depth_first(forest, nodes);
  of_polygon_.resize(forest.polygons());
  aggregates_.reserve(nodes.size());
  for (std::uint32_t z = 0; z < nodes.size(); ++z) {
    const PatchId id = nodes[z].id;
    aggregates_.push_back({id, nodes[z].area_m2});
    if (!id.is_group()) {
      const bool first = id.path == 1u << (std::bit_width(id.path) - 1);
      if (first) of_polygon_[id.root].begin = z;
      of_polygon_[id.root].end = z + 1;
      continue;
    }
    const GroupNode& group = forest.groups()[id.group()];
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
      of_polygon_[forest.order()[i]] = {z, z + 1};
    }
  }
}

Aggregates::Range Aggregates::of(const PatchForest& forest, PatchId node) const {
  if (aggregates_.empty()) return {};
  if (node.is_group()) {
    const GroupNode& group = forest.groups()[node.group()];
    return {of_polygon_[forest.order()[group.begin]].begin,
            of_polygon_[forest.order()[group.end - 1]].end};
  }
  Range range = of_polygon_[node.root];
  if (range.size() == 1) return range;
  const auto apart = [&](std::uint32_t aggregate) {
    return !related(aggregates_[aggregate].node.path, node.path);
  };
  while (apart(range.begin)) ++range.begin;
  while (apart(range.end - 1)) --range.end;
  return range;
}

void Aggregates::add(const PatchForest& forest, PatchId patch, std::span<const double> power,
                     std::span<double> sums) const {
  const Range range = of(forest, patch);
  double area = 0.0;
  for (std::uint32_t z = range.begin; z < range.end; ++z) {
    area += range.size() == 1 ? 1.0 : aggregates_[z].area_m2;
  }
  for (std::uint32_t z = range.begin; z < range.end; ++z) {
    const double share = range.size() == 1 ? 1.0 : area > 0.0 ? aggregates_[z].area_m2 / area : 0.0;
    for (std::size_t b = 0; b < power.size(); ++b) {
      sums[z * power.size() + b] += share * power[b];
    }
  }
}

std::vector<double> Aggregates::reflected_power(const PatchForest& forest) const {
  const auto bands = static_cast<std::size_t>(forest.bands());
  std::vector<double> power(size() * bands, 0.0);
  for (std::size_t z = 0; z < size(); ++z) {
    const PatchId id = aggregates_.empty() ? forest.root() : aggregates_[z].node;
    const double area = aggregates_.empty() ? 1.0 : aggregates_[z].area_m2;
    for (std::size_t b = 0; b < bands; ++b) {
      const double mean =
          id.is_group()
              ? forest.group_radiosity(id.group())[b]
              : forest.radiosity(forest.find(id))[b * static_cast<std::size_t>(forest.terms())];
      power[z * bands + b] = area * std::max(0.0, mean - forest.exitance(id, b));
    }
  }
  return power;
}

/// The mean by area of the aggregates' shares in one band.
double Aggregates::mean_share(Range range, std::span<const double> shares, std::size_t band,
                              std::size_t bands) const {
  double share = 0.0, area = 0.0;
  for (std::uint32_t z = range.begin; z < range.end; ++z) {
    const double weight = range.size() == 1 ? 1.0 : aggregates_[z].area_m2;
    share += weight * shares[z * bands + band];
    area += weight;
  }
  return area > 0.0 ? share / area : 0.0;
}

void Aggregates::add_share(PatchForest& forest, std::span<const double> shares) const {
  const auto bands = static_cast<std::size_t>(forest.bands());
  const auto terms = static_cast<std::size_t>(forest.terms());
  ENFILADE_CHECK(shares.size() >= size() * bands, std::to_string(shares.size()));
  const LeafLight light(forest, *this);
  for (std::size_t i = 0; i < forest.size(); ++i) {
    const PatchNode& leaf = forest.node(i);
    if (!leaf.leaf()) continue;
    const LeafLight::Part& part = light.of(leaf);
    const Range range = of(forest, leaf.id);
    for (std::size_t b = 0; b < bands; ++b) {
      const double share = mean_share(range, shares, b, bands);
      const double uniform = share > 0.0 ? part.uniform[b] : 0.0;
      for (std::size_t t = 0; t < terms; ++t) {
        double& e = forest.irradiance(i)[b * terms + t];
        const double uniform_part = t == 0 ? uniform * part.mean[b] : 0.0;
        e += share * (uniform_part + (1.0 - uniform) * e);
      }
    }
  }
  forest.pull();
}

}  // namespace enfilade
