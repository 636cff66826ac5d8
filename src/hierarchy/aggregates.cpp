#include "hierarchy/aggregates.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <queue>

#include "base/error.hpp"

namespace enfilade {
namespace {

/// One lies on the way from the root to the other.
bool related(std::uint32_t a, std::uint32_t b) {
  const int deeper = std::bit_width(b) - std::bit_width(a);
  return deeper >= 0 ? (b >> deeper) == a : (a >> -deeper) == b;
}

PatchId named(std::int32_t child) {
  return child < 0 ? PatchId{static_cast<std::uint32_t>(~child), 1}
                   : PatchId{PatchId::group_bit + static_cast<std::uint32_t>(child), 1};
}

}  // namespace

Aggregates::Aggregates(const PatchForest& forest, std::size_t most) {
  if (most < 2) return;
  struct Node {
    PatchId id;
    double area_m2;
    PatchShape shape;  ///< of a patch
    bool operator<(const Node& o) const {
      return area_m2 != o.area_m2 ? area_m2 < o.area_m2 : id > o.id;
    }
  };
  const auto node = [&](PatchId id) {
    if (id.is_group()) return Node{id, forest.groups()[id.group()].area_m2, {}};
    const PatchShape& shape = forest.node(id.root).shape;
    return Node{id, shape.area_m2, shape};
  };
  std::priority_queue<Node> parts;
  parts.push(node(forest.root()));
  std::vector<Node> whole;  // at the end of their paths
  while (!parts.empty() && parts.size() + whole.size() < most) {
    const Node largest = parts.top();
    parts.pop();
    if (largest.id.is_group()) {
      const GroupNode& group = forest.groups()[largest.id.group()];
      parts.push(node(named(group.left)));
      parts.push(node(named(group.right)));
    } else if (std::bit_width(largest.id.path) == 32) {
      whole.push_back(largest);
    } else {
      auto halves = largest.shape.halves(largest.shape.cut(forest.frames()[largest.id.root].lines));
      const double areas[2] = {halves.first.area_m2, halves.second.area_m2};
      parts.push({largest.id.child(0), areas[0], std::move(halves.first)});
      parts.push({largest.id.child(1), areas[1], std::move(halves.second)});
    }
  }
  for (; !parts.empty(); parts.pop()) whole.push_back(parts.top());

  // Depth first: by the polygons' order, then along the paths, aligned to the left.
  std::vector<std::uint32_t> place(forest.polygons());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[forest.order()[i]] = i;
  const auto first_place = [&](PatchId id) {
    return id.is_group() ? forest.groups()[id.group()].begin : place[id.root];
  };
  const auto aligned = [](PatchId id) { return id.path << (32 - std::bit_width(id.path)); };
  std::sort(whole.begin(), whole.end(), [&](const Node& a, const Node& b) {
    return std::pair(first_place(a.id), aligned(a.id)) <
           std::pair(first_place(b.id), aligned(b.id));
  });
  of_polygon_.resize(forest.polygons());
  aggregates_.reserve(whole.size());
  for (std::uint32_t z = 0; z < whole.size(); ++z) {
    const PatchId id = whole[z].id;
    aggregates_.push_back({id, whole[z].area_m2});
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

void Aggregates::add_share(PatchForest& forest, std::span<const double> shares) const {
  const auto bands = static_cast<std::size_t>(forest.bands());
  const auto terms = static_cast<std::size_t>(forest.terms());
  ENFILADE_CHECK(shares.size() >= size() * bands, std::to_string(shares.size()));
  /// A polygon's leaves in one aggregate (or one larger leaf over several): their light in the
  /// mean, and what of an addition is spread evenly.
  struct Part {
    double area_m2 = 0.0;
    std::vector<double> mean, even;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Part> parts;  // by polygon, first aggregate
  const auto part_of = [&](const PatchNode& leaf) {
    return std::pair(leaf.id.root, of(forest, leaf.id).begin);
  };
  for (std::size_t i = 0; i < forest.size(); ++i) {
    const PatchNode& leaf = forest.node(i);
    if (!leaf.leaf()) continue;
    Part& part = parts[part_of(leaf)];
    part.mean.resize(bands, 0.0);
    part.even.resize(bands, 1.0);
    part.area_m2 += leaf.shape.area_m2;
    for (std::size_t b = 0; b < bands; ++b) {
      part.mean[b] += leaf.shape.area_m2 * forest.irradiance(i)[b * terms];
    }
  }
  for (auto& [name, part] : parts) {
    for (double& mean : part.mean) mean = part.area_m2 > 0.0 ? mean / part.area_m2 : 0.0;
  }
  for (std::size_t i = 0; i < forest.size(); ++i) {
    if (!forest.node(i).leaf()) continue;
    Part& part = parts[part_of(forest.node(i))];
    for (std::size_t b = 0; b < bands; ++b) {
      const double mean = part.mean[b];
      const double least = mean > 0.0 ? forest.irradiance(i)[b * terms] / mean : 0.0;
      part.even[b] = std::clamp(least, 0.0, part.even[b]);
    }
  }
  for (std::size_t i = 0; i < forest.size(); ++i) {
    const PatchNode& leaf = forest.node(i);
    if (!leaf.leaf()) continue;
    const Part& part = parts[part_of(leaf)];
    const Range range = of(forest, leaf.id);
    for (std::size_t b = 0; b < bands; ++b) {
      double share = 0.0, area = 0.0;
      for (std::uint32_t z = range.begin; z < range.end; ++z) {
        const double weight = range.size() == 1 ? 1.0 : aggregates_[z].area_m2;
        share += weight * shares[z * bands + b];
        area += weight;
      }
      share = area > 0.0 ? share / area : 0.0;
      const double evenly = share > 0.0 ? part.even[b] : 0.0;
      for (std::size_t t = 0; t < terms; ++t) {
        double& e = forest.irradiance(i)[b * terms + t];
        const double all_over = t == 0 ? evenly * part.mean[b] : 0.0;
        e += share * (all_over + (1.0 - evenly) * e);
      }
    }
  }
  forest.pull();
}

void Aggregates::write(ByteWriter& w) const {
  w.put(static_cast<std::uint64_t>(aggregates_.size()));
  for (const auto& [node, area_m2] : aggregates_) {
    w.put(node);
    w.put(area_m2);
  }
  w.put_all(of_polygon_);
}

Aggregates Aggregates::read(ByteReader& r) {
  Aggregates aggregates;
  aggregates.aggregates_.resize(r.get_count(sizeof(PatchId) + sizeof(double)));
  for (auto& [node, area_m2] : aggregates.aggregates_) {
    node = r.get<PatchId>();
    area_m2 = r.get<double>();
  }
  aggregates.of_polygon_ = r.get_all<Range>();
  return aggregates;
}

}  // namespace enfilade
