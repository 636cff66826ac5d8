#include "cells/leaf_merge.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace enfilade {
namespace {

constexpr std::uint32_t outside_group = 0;
constexpr double solid_ratio = 4.0;

// A side of a plane: plane * 2 for the side in front of it, plane * 2 + 1 for the one behind.
using PlaneSide = std::uint32_t;

struct Contact {
  double area = 0.0, open = 0.0, framed = 0.0;
};

// Leaves that belong together so far. A contact is filed under the plane side that this group is
// on.
struct Group {
  double volume = 0.0, front = 0.0, back = 0.0;
  std::map<PlaneSide, double> faces;
  std::map<std::uint32_t, std::map<PlaneSide, Contact>> contacts;

  // Real models show a room a wrong side here and there; the inside of a solid shows hardly
  // anything else.
  bool is_solid() const { return back > solid_ratio * front; }
  bool has_evidence() const { return back + front > 0.0; }
  double boundary() const {
    double sum = 0.0;
    for (const auto& [side, area] : faces) sum += area;
    return sum;
  }
  double open_to(std::uint32_t other) const {
    double sum = 0.0;
    const auto at = contacts.find(other);
    if (at == contacts.end()) return 0.0;
    for (const auto& [side, contact] : at->second) sum += contact.open;
    return sum;
  }
  // The largest opening in one side of one plane, to whomever.
  double largest_opening() const {
    std::map<PlaneSide, double> by_side;
    for (const auto& [other, sides] : contacts) {
      for (const auto& [side, contact] : sides) by_side[side] += contact.open;
    }
    double most = 0.0;
    for (const auto& [side, open] : by_side) most = std::max(most, open);
    return most;
  }
};

struct Candidate {
  double score = 0.0;
  std::uint32_t a = 0, b = 0, via = 0xFFFFFFFFu;  ///< via: the connector that joins a and b

  bool operator<(const Candidate& o) const {
    if (score != o.score) return score > o.score;
    return std::tie(a, b, via) < std::tie(o.a, o.b, o.via);
  }
};

class Merger {
 public:
  Merger(std::span<const double> volume, std::span<const char> touches_outside,
         std::span<const LeafInterface> interfaces, const MergeConfig& config)
      : config_(config), groups_(volume.size() + 1), parent_(volume.size() + 1) {
    for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = i;
    for (std::size_t i = 0; i < volume.size(); ++i) groups_[i + 1].volume = volume[i];
    for (const LeafInterface& face : interfaces) add(face);
    for (std::uint32_t i = 0; i < touches_outside.size(); ++i) {
      if (touches_outside[i]) join(outside_group, i + 1);
    }
  }

  void run() {
    while (round(&Merger::room_candidates)) {
    }
    while (round(&Merger::outside_candidates)) {
    }
    while (round(&Merger::leftover_candidates)) {
    }
    while (round(&Merger::leaking_solids)) {
    }
    while (round(&Merger::enclosed_solids)) {
    }
    join_crumbs();
  }

  LeafGroups result() {
    LeafGroups out;
    const std::vector<char> is_room = find_rooms();
    std::map<std::uint32_t, std::uint32_t> number;
    for (std::uint32_t leaf = 1; leaf < parent_.size(); ++leaf) {
      const std::uint32_t group = find(leaf);
      const auto [at, is_new] =
          number.try_emplace(group, static_cast<std::uint32_t>(out.kinds.size()));
      if (is_new) {
        out.kinds.push_back(group == outside_group ? CellKind::outside
                            : is_room[group]       ? CellKind::room
                                                   : CellKind::solid);
      }
      out.group_of_leaf.push_back(at->second);
    }
    return out;
  }

 private:
  std::uint32_t find(std::uint32_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  bool alive(std::uint32_t i) const { return parent_[i] == i; }

  void add(const LeafInterface& face) {
    const std::uint32_t a = face.front_leaf + 1, b = face.back_leaf + 1;
    const PlaneSide in_front = 2 * face.plane, behind = in_front + 1;
    const auto meet = [&](std::uint32_t g, std::uint32_t h, PlaneSide side) {
      groups_[g].faces[side] += face.area_m2;
      Contact& contact = groups_[g].contacts[h][side];
      contact.area += face.area_m2;
      contact.open += face.open_m2;
      contact.framed += face.framed_m2;
    };
    meet(a, b, in_front);
    meet(b, a, behind);
    // What is covered and does not face a leaf shows it a back: the inside of something solid.
    const double covered = face.area_m2 - face.open_m2;
    groups_[a].front += face.faces_front_m2;
    groups_[a].back += std::max(0.0, covered - face.faces_front_m2);
    groups_[b].front += face.faces_back_m2;
    groups_[b].back += std::max(0.0, covered - face.faces_back_m2);
  }

  // h becomes part of g; the outside stays the outside.
  void join(std::uint32_t g, std::uint32_t h) {
    g = find(g);
    h = find(h);
    if (g == h) return;
    if (h == outside_group) std::swap(g, h);
    Group& to = groups_[g];
    Group& from = groups_[h];
    // Contacts are moved from the smaller map, so that a big group stays cheap to add to.
    if (g != outside_group && from.contacts.size() > to.contacts.size()) {
      std::swap(g, h);
      join_into(groups_[g], groups_[h], g, h);
    } else {
      join_into(to, from, g, h);
    }
    parent_[h] = g;
  }

  void join_into(Group& to, Group& from, std::uint32_t g, std::uint32_t h) {
    to.volume += from.volume;
    to.front += from.front;
    to.back += from.back;
    for (const auto& [side, area] : from.faces) to.faces[side] += area;
    for (const auto& [side, contact] : from.contacts[g]) {
      lower(to.faces, side, contact.area);
      lower(to.faces, side ^ 1u, contact.area);
    }
    to.contacts.erase(h);
    from.contacts.erase(g);
    for (const auto& [other, sides] : from.contacts) {
      auto& there = groups_[other].contacts;
      for (const auto& [side, contact] : sides) {
        Contact& mine = to.contacts[other][side];
        mine.area += contact.area;
        mine.open += contact.open;
        mine.framed += contact.framed;
        Contact& theirs = there[g][side ^ 1u];
        theirs.area += contact.area;
        theirs.open += contact.open;
        theirs.framed += contact.framed;
      }
      there.erase(h);
    }
    from = Group{};
  }

  static void lower(std::map<PlaneSide, double>& faces, PlaneSide side, double area) {
    const auto at = faces.find(side);
    if (at != faces.end()) at->second = std::max(0.0, at->second - area);
  }

  // A thin group between others: its depth is its volume over its opening.
  bool is_connector(const Group& g) const {
    const double opening = g.largest_opening();
    return opening > 0.0 && g.volume < config_.connector_depth * opening * std::sqrt(opening);
  }

  bool disagree(const Group& g, const Group& h) const {
    return g.has_evidence() && h.has_evidence() && g.is_solid() != h.is_solid();
  }

  // Mean chord of a region, after Cauchy.
  static double chord(const Group& g) {
    const double boundary = g.boundary();
    return boundary > 0.0 ? 4.0 * g.volume / boundary : 0.0;
  }

  static double volume(const Group& g) { return g.volume; }

  // What half of the volume of all that is no solid has at least, of chord or of volume.
  double typical(double (*measure)(const Group&)) const {
    std::vector<std::pair<double, double>> by_measure;  // and volume
    double total = 0.0;
    for (std::uint32_t i = 1; i < groups_.size(); ++i) {
      if (!alive(i) || groups_[i].is_solid()) continue;
      by_measure.emplace_back(measure(groups_[i]), groups_[i].volume);
      total += groups_[i].volume;
    }
    std::sort(by_measure.begin(), by_measure.end());
    double sum = 0.0;
    for (const auto& [value, share] : by_measure) {
      sum += share;
      if (2.0 * sum >= total) return value;
    }
    return 0.0;
  }

  // Has the group a door to what is known as a room (or the outside)?
  bool has_door(const Group& g, const std::vector<char>& is_room) const {
    std::map<PlaneSide, double> open;
    for (const auto& [other, sides] : g.contacts) {
      if (!is_room[other]) continue;
      for (const auto& [side, contact] : sides) open[side] += contact.open;
    }
    return std::any_of(open.begin(), open.end(), [&](const auto& at) {
      const double face = std::max(g.faces.at(at.first), std::pow(g.volume, 2.0 / 3.0));
      return at.second >= config_.door_share * face;
    });
  }

  // Real walls and floors are layers with faces of every direction between them, so that the faces
  // alone do not tell them from rooms.
  std::vector<char> find_rooms() const {
    std::vector<char> is_room(groups_.size(), 0);
    is_room[outside_group] = 1;
    const double least = config_.thin_share * typical(chord);
    const double closet = config_.closet_share * typical(volume);
    for (std::uint32_t i = 1; i < groups_.size(); ++i) {
      is_room[i] = alive(i) && !groups_[i].is_solid() && chord(groups_[i]) >= least;
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (std::uint32_t i = 1; i < groups_.size(); ++i) {
        if (!alive(i) || is_room[i] || groups_[i].is_solid()) continue;
        if (groups_[i].volume < closet) continue;
        if (!has_door(groups_[i], is_room)) continue;
        is_room[i] = 1;
        changed = true;
      }
    }
    return is_room;
  }

  // How much two touching groups are one room: 0 where they are not.
  double score(std::uint32_t a, std::uint32_t b) const {
    const Group& g = groups_[a];
    const Group& h = groups_[b];
    double open = 0.0, framed = 0.0, g_face = 0.0, h_face = 0.0;
    for (const auto& [side, contact] : g.contacts.at(b)) {
      open += contact.open;
      framed += contact.framed;
      g_face += g.faces.at(side);
      h_face += h.faces.at(side ^ 1u);
    }
    return share(open, framed, g_face, h_face, g, h);
  }

  double share(double open, double framed, double g_face, double h_face, const Group& g,
               const Group& h) const {
    if (open <= 0.0 || g_face <= 0.0 || h_face <= 0.0) return 0.0;
    const double mean = open / std::sqrt(g_face * h_face);
    const bool door = framed >= config_.framed_share * open;
    if (mean >= config_.open_share && !door) return std::min(mean, 1.0);
    const bool g_is_smaller = g.volume < h.volume;
    const Group& nook = g_is_smaller ? g : h;
    const double own = open / (g_is_smaller ? g_face : h_face);
    const double depth = nook.volume / open;
    const bool is_nook =
        own >= config_.nook_open_share && depth <= config_.nook_depth * std::sqrt(open);
    return is_nook ? mean : 0.0;
  }

  void room_candidates(std::vector<Candidate>& out) const {
    std::vector<char> thin(groups_.size(), 0);
    for (std::uint32_t i = 1; i < groups_.size(); ++i) {
      thin[i] = alive(i) && is_connector(groups_[i]);
    }
    for (std::uint32_t i = 1; i < groups_.size(); ++i) {
      if (!alive(i)) continue;
      for (const auto& [j, sides] : groups_[i].contacts) {
        if (j <= i || thin[i] != thin[j] || disagree(groups_[i], groups_[j])) continue;
        const double s = score(i, j);
        if (s > 0.0) out.push_back({s, i, j});
      }
      if (thin[i]) through_connector(i, thin, out);
    }
  }

  // Two groups on both sides of a thin one are judged as if it were not there.
  void through_connector(std::uint32_t c, const std::vector<char>& thin,
                         std::vector<Candidate>& out) const {
    struct Side {
      std::uint32_t group;
      double open, framed, face;
    };
    std::vector<Side> sides;
    for (const auto& [other, contacts] : groups_[c].contacts) {
      if (other == outside_group || thin[other] || disagree(groups_[other], groups_[c])) continue;
      Side side{other, 0.0, 0.0, 0.0};
      for (const auto& [plane_side, contact] : contacts) {
        if (contact.open <= 0.0) continue;
        side.open += contact.open;
        side.framed += contact.framed;
        side.face += groups_[other].faces.at(plane_side ^ 1u);
      }
      if (side.open > 0.0) sides.push_back(side);
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (std::size_t j = i + 1; j < sides.size(); ++j) {
        const Group& g = groups_[sides[i].group];
        const Group& h = groups_[sides[j].group];
        if (disagree(g, h)) continue;
        const double open = std::min(sides[i].open, sides[j].open);
        const double framed =
            0.5 * open * (sides[i].framed / sides[i].open + sides[j].framed / sides[j].open);
        const double s = share(open, framed, sides[i].face, sides[j].face, g, h);
        if (s > 0.0) out.push_back({s, sides[i].group, sides[j].group, c});
      }
    }
  }

  void outside_candidates(std::vector<Candidate>& out) const {
    for (const auto& [g, sides] : groups_[outside_group].contacts) {
      const Group& group = groups_[g];
      if (group.is_solid() || is_connector(group)) continue;
      const double whole = group.boundary(), open = group.open_to(outside_group);
      if (whole > 0.0 && open >= config_.outside_share * whole) {
        out.push_back({open / whole, outside_group, g});
      }
    }
  }

  // A connector that joins two rooms goes to the one that it is more open to; inside before
  // outside.
  void leftover_candidates(std::vector<Candidate>& out) const {
    for (std::uint32_t i = 1; i < groups_.size(); ++i) {
      if (!alive(i) || !is_connector(groups_[i])) continue;
      Candidate best;
      for (const auto& [j, sides] : groups_[i].contacts) {
        if (disagree(groups_[i], groups_[j])) continue;
        const double open = groups_[i].open_to(j);
        const double s = j == outside_group ? open * (1.0 - 1e-3) : open;
        if (s > best.score * (1.0 + 1e-6)) best = {s, std::min(i, j), std::max(i, j)};
      }
      if (best.score > 0.0) out.push_back(best);
    }
  }

  // A solid that is not tight is part of what it leaks to: no room is seen through a wall's cracks
  // then but through the other side's, and no portal leads into a wall.
  void leaking_solids(std::vector<Candidate>& out) const {
    for (std::uint32_t i = 1; i < groups_.size(); ++i) {
      if (!alive(i) || !groups_[i].is_solid()) continue;
      Candidate best;
      for (const auto& [j, sides] : groups_[i].contacts) {
        const double open = groups_[i].open_to(j);
        if (open > best.score * (1.0 + 1e-6)) best = {open, std::min(i, j), std::max(i, j)};
      }
      if (best.score > 0.0) out.push_back(best);
    }
  }

  // Furniture stands in one room: a solid that has most of its boundary there is part of it. A wall
  // or a slab has at most half of it on one side.
  void enclosed_solids(std::vector<Candidate>& out) const {
    for (std::uint32_t i = 1; i < groups_.size(); ++i) {
      if (!alive(i) || !groups_[i].is_solid()) continue;
      const double whole = groups_[i].boundary();
      for (const auto& [j, sides] : groups_[i].contacts) {
        double touching = 0.0;
        for (const auto& [side, contact] : sides) touching += contact.area;
        if (!groups_[j].is_solid() && touching > config_.enclosed_share * whole) {
          out.push_back({touching, std::min(i, j), std::max(i, j)});
        }
      }
    }
  }

  // The smallest groups (the insides of furniture, gaps behind it) go to the neighbour that they
  // touch most, smallest first, until they hold the share of the volume that rooms do not miss.
  // More in one cell is always safe: what is in one cell is taken to see each other.
  void join_crumbs() {
    std::vector<std::pair<double, std::uint32_t>> by_volume;
    double total = 0.0;
    for (std::uint32_t i = 1; i < groups_.size(); ++i) {
      if (!alive(i)) continue;
      by_volume.emplace_back(groups_[i].volume, i);
      total += groups_[i].volume;
    }
    std::sort(by_volume.begin(), by_volume.end());
    double crumbs = 0.0;
    for (const auto& [volume, i] : by_volume) {
      crumbs += volume;
      if (crumbs > config_.crumb_share * total) break;
      const std::uint32_t g = find(i);
      if (g == outside_group || groups_[g].volume > config_.crumb_share * total) continue;
      double most = 0.0;
      std::uint32_t target = g;
      for (const auto& [other, sides] : groups_[g].contacts) {
        double area = 0.0;
        for (const auto& [side, contact] : sides) area += contact.area;
        if (area > most * (1.0 + 1e-9)) {
          most = area;
          target = other;
        }
      }
      if (target != g) join(g, target);
    }
  }

  // One round: the best candidates first, each group in at most one. False when there was none.
  bool round(void (Merger::*find_candidates)(std::vector<Candidate>&) const) {
    std::vector<Candidate> candidates;
    (this->*find_candidates)(candidates);
    std::sort(candidates.begin(), candidates.end());
    std::vector<char> touched(groups_.size(), 0);
    for (const Candidate& c : candidates) {
      const bool has_via = c.via != 0xFFFFFFFFu;
      if (touched[c.a] || touched[c.b] || (has_via && touched[c.via])) continue;
      touched[c.a] = c.a != outside_group;
      touched[c.b] = 1;
      if (has_via) touched[c.via] = 1;
      join(c.a, c.b);
      if (has_via) join(find(c.a), c.via);
    }
    return !candidates.empty();
  }

  MergeConfig config_;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> parent_;
};

}  // namespace

LeafGroups merge_leaves(std::span<const double> volume_m3, std::span<const char> touches_outside,
                        std::span<const LeafInterface> interfaces, const MergeConfig& config) {
  Merger merger(volume_m3, touches_outside, interfaces, config);
  merger.run();
  return merger.result();
}

}  // namespace enfilade
