#include "bounds/iteration/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace enfilade {
namespace {

/// A link by its receiver's number and its own, and how much it widens the targets.
struct Candidate {
  std::uint32_t receiver, link;
  double width;
};

/// How much a link widens its receiver's mean, and the range of its points, in one band.
double width_of(const BoundLink& link, const LightRange& light, double reference,
                double point_weight, double radius_m) {
  const PairFactor& f = link.factor;
  const double off =
      std::max(std::abs(light.at_points.hi - reference), std::abs(light.at_points.lo - reference));
  const double deviation = light.deviation, range = light.at_points.width();
  const double mean =
      f.mean.width() * off + std::min(2.0 * f.mean_spread * deviation, f.mean.hi * range);
  const double reach = f.at_points.remainder + 0.3 * glm::length(f.at_points.gradient) * radius_m;
  const double points =
      2.0 * reach * off + std::min(2.0 * f.point_spread * deviation,
                                   (f.at_points.center + f.at_points.remainder) * range);
  return mean + point_weight * points;
}

std::vector<Candidate> candidates_of(const BoundState& state, std::span<const double> weights,
                                     double point_weight) {
  const std::size_t bands = state.scene().bands;
  const auto& receivers = state.receivers();
  std::vector<std::vector<Candidate>> found(receivers.size());
  for_all(receivers.size(), state.threads(), [&](std::size_t i) {
    const Receiver& r = receivers[i];
    const BoundNode& node = state.tree()[r.node];
    for (std::size_t k = 0; k < r.links.size(); ++k) {
      double width = 0.0;
      for (std::size_t band = 0; band < bands; ++band) {
        const double reference = std::max(0.0, r.references[band].mean_upper);
        width += weights[node.polygon * bands + band] *
                 width_of(r.links[k], state.radiosity(r.links[k].shooter, band), reference,
                          point_weight, node.shape.radius_m);
      }
      width *= node.area_m2;
      if (width > 0.0)
        found[i].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), width});
    }
  });
  std::vector<Candidate> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

bool is_wider(const Candidate& a, const Candidate& b) {
  if (a.width != b.width) return a.width > b.width;
  return a.receiver != b.receiver ? a.receiver < b.receiver : a.link < b.link;
}

/// What a round does.
struct Cuts {
  std::vector<std::vector<std::uint32_t>> links;            ///< per receiver: those replaced by two
  std::vector<std::pair<double, std::uint32_t>> receivers;  ///< by what they would narrow
};

/// Cuts the shooter of each link, unless it is smaller than `larger` times the receiver: an inner
/// node of the tree for this link alone, a leaf for all.
Cuts choose(const BoundState& state, std::span<const Candidate> candidates, double larger) {
  const auto& receivers = state.receivers();
  std::vector<std::uint32_t> receiver_of(state.tree().size(), no_index);
  for (std::size_t i = 0; i < receivers.size(); ++i)
    receiver_of[receivers[i].node] = static_cast<std::uint32_t>(i);
  Cuts cuts;
  cuts.links.resize(receivers.size());
  std::vector<double> votes(receivers.size(), 0.0);
  for (const Candidate& c : candidates) {
    const Receiver& r = receivers[c.receiver];
    const std::uint32_t shooter = r.links[c.link].shooter;
    const BoundNode &from = state.tree()[shooter], &to = state.tree()[r.node];
    if (from.is_group() || from.size_m() >= larger * to.size_m()) {
      if (from.is_leaf()) {
        votes[receiver_of[shooter]] += c.width;
      } else {
        cuts.links[c.receiver].push_back(c.link);
      }
    } else {
      votes[c.receiver] += c.width;
    }
  }
  for (std::uint32_t i = 0; i < votes.size(); ++i) {
    if (votes[i] > 0.0) cuts.receivers.emplace_back(votes[i], i);
  }
  std::sort(cuts.receivers.begin(), cuts.receivers.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  return cuts;
}

/// Links from the parts of `whole` that can be seen from the leaf.
void add_links(const BoundState& state, std::uint32_t leaf, std::uint32_t shooter, bool open,
               std::vector<BoundLink>& out) {
  PairFactor factor = state.factor(leaf, shooter, open);
  if (!factor.none()) out.push_back({shooter, factor});
}

/// Finds where each wall's parts stand among the links; a wall without parts is dropped.
void place_walls(const BoundState& state, std::vector<BoundWall> walls, Receiver& receiver) {
  receiver.walls.clear();
  const std::vector<BoundLink>& links = receiver.links;
  for (std::uint32_t begin = 0, end = 0; begin < links.size(); begin = end) {
    const std::uint32_t polygon = state.tree()[links[begin].shooter].polygon;
    for (end = begin + 1; end < links.size() && polygon != no_index &&
                          state.tree()[links[end].shooter].polygon == polygon;) {
      ++end;
    }
    const auto wall = std::find_if(walls.begin(), walls.end(),
                                   [&](const BoundWall& w) { return w.polygon == polygon; });
    if (wall == walls.end()) continue;
    receiver.walls.push_back({polygon, wall->whole, begin, end});
  }
}

void cut_links(const BoundState& state, const std::vector<std::uint32_t>& cut, Receiver& receiver) {
  std::vector<char> is_cut(receiver.links.size(), 0);
  for (const std::uint32_t k : cut) is_cut[k] = 1;
  std::vector<BoundLink> links;
  std::vector<BoundWall> walls = receiver.walls;
  for (std::size_t k = 0; k < receiver.links.size(); ++k) {
    const BoundLink& link = receiver.links[k];
    if (!is_cut[k]) {
      links.push_back(link);
      continue;
    }
    const BoundNode& from = state.tree()[link.shooter];
    if (!from.is_group() && state.tree().polygon_nodes()[from.polygon] == link.shooter)
      walls.push_back({from.polygon, link.factor});
    const std::uint32_t first = from.first_child;
    for (std::uint32_t part = first; part < first + 2; ++part)
      add_links(state, receiver.node, part, link.factor.open, links);
  }
  receiver.links = std::move(links);
  place_walls(state, std::move(walls), receiver);
}

}  // namespace

std::size_t refine(BoundState& state, std::span<const double> weights,
                   const BoundsRefinementConfig& config) {
  std::vector<Candidate> candidates = candidates_of(state, weights, config.point_weight);
  if (candidates.empty()) return 0;
  const std::size_t links = state.links();
  const std::size_t chosen = std::min(
      candidates.size(),
      std::max(config.least_chosen,
               static_cast<std::size_t>(config.chosen_share * static_cast<double>(links))));
  std::nth_element(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(chosen - 1),
                   candidates.end(), is_wider);
  const Cuts cuts = choose(state, std::span(candidates).first(chosen), config.shooter_share);
  std::vector<Receiver>& receivers = state.receivers();
  for_all(receivers.size(), state.threads(), [&](std::size_t i) {
    if (!cuts.links[i].empty()) cut_links(state, cuts.links[i], receivers[i]);
  });
  std::size_t evaluated = 0;
  for (const auto& cut : cuts.links) evaluated += 2 * cut.size();
  std::size_t room = std::max(config.least_growth,
                              static_cast<std::size_t>(config.growth * static_cast<double>(links)));
  struct Half {
    std::size_t receiver;
    std::vector<BoundLink> of_whole;
    std::vector<BoundWall> walls;
  };
  std::vector<Half> fresh;
  for (const auto& [width, i] : cuts.receivers) {
    const std::size_t added = receivers[i].links.size();
    if (added > room) break;
    room -= added;
    evaluated += 2 * added;
    std::vector<BoundLink> whole = receivers[i].links;
    std::vector<BoundWall> walls = receivers[i].walls;
    state.split_receiver(i);
    fresh.push_back({receivers.size() - 1, whole, walls});
    fresh.push_back({i, std::move(whole), std::move(walls)});
  }
  for_all(fresh.size(), state.threads(), [&](std::size_t i) {
    Receiver& r = receivers[fresh[i].receiver];
    for (const BoundLink& link : fresh[i].of_whole)
      add_links(state, r.node, link.shooter, link.factor.open, r.links);
    for (BoundWall& wall : fresh[i].walls)
      wall.whole =
          state.factor(r.node, state.tree().polygon_nodes()[wall.polygon], wall.whole.open);
    place_walls(state, std::move(fresh[i].walls), r);
  });
  return evaluated;
}

}  // namespace enfilade
