#include "schemes/master/cell_dealer.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "tour/order.hpp"

namespace enfilade {
namespace {

/// The graph of cells: two cells see each other if two of their clusters do.
struct CellGraph {
  std::vector<std::vector<ClusterId>> cells;
  ClusterGraph graph;
  std::vector<std::uint64_t> polygons;

  explicit CellGraph(const Prepared& prepared) {
    std::map<CellId, std::uint32_t> place;
    std::vector<std::uint32_t> cell_of;
    for (std::size_t c = 0; c < prepared.clusters.size(); ++c) {
      const Cluster& cluster = prepared.clusters[c];
      const auto at = place.emplace(cluster.cell, static_cast<std::uint32_t>(cells.size()));
      if (at.second) {
        cells.emplace_back();
        polygons.push_back(0);
      }
      cell_of.push_back(at.first->second);
      cells[cell_of.back()].emplace_back(c);
      polygons[cell_of.back()] += cluster.polygons.size();
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::size_t c = 0; c < cell_of.size(); ++c) {
      for (const std::uint32_t n : prepared.graph.neighbours(c)) {
        if (cell_of[c] < cell_of[n]) pairs.emplace_back(cell_of[c], cell_of[n]);
      }
    }
    graph = ClusterGraph(cells.size(), std::move(pairs));
  }
};

std::vector<std::vector<ClusterId>> cells_on_tour(const Prepared& prepared, std::uint64_t seed) {
  const CellGraph cells(prepared);
  const VisibilityCost cost(cells.graph, cells.polygons, std::numeric_limits<std::uint64_t>::max());
  std::vector<ClusterId> nodes;  // of the graph of cells
  for (std::size_t i = 0; i < cells.cells.size(); ++i) nodes.emplace_back(i);
  const auto order = make_order(TourOrder::travelling_salesman, seed, cells.graph);
  std::vector<std::vector<ClusterId>> on_tour;
  for (const ClusterId node : order->arrange(nodes, cost))
    on_tour.push_back(cells.cells[node.index()]);
  return on_tour;
}

}  // namespace

CellDealer::CellDealer(const Prepared& prepared, int slaves,
                       const std::vector<double>& emitted_power, std::uint64_t seed, bool steal)
    : light_(prepared.graph, emitted_power),
      work_(prepared),
      steal_(steal),
      cells_(cells_on_tour(prepared, seed)),
      slaves_(static_cast<std::size_t>(slaves)) {}

void CellDealer::start() {
  first_iteration_ = gathered_.empty();
  moved_ = 0;
  gathered_.clear();
  for (Slave& slave : slaves_) slave = Slave{};
  cells_to_come_.clear();
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_to_come_.push_back(i);
}

std::size_t CellDealer::choose_cell() const {
  if (first_iteration_) return 0;
  const auto waiting = [this](std::size_t at) {
    double power = 0.0;
    for (const ClusterId c : cells_[cells_to_come_[at]]) power += light_.waiting_power(c);
    return power;
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < cells_to_come_.size(); ++i) {
    if (waiting(i) > waiting(best)) best = i;
  }
  return best;
}

bool CellDealer::open_cell() {
  if (cells_to_come_.empty()) return false;
  const std::size_t chosen = choose_cell();
  cell_ = cells_to_come_[chosen];
  cells_to_come_.erase(cells_to_come_.begin() + static_cast<std::ptrdiff_t>(chosen));
  Clusters heaviest_first = cells_[cell_];
  std::stable_sort(heaviest_first.begin(), heaviest_first.end(),
                   [this](ClusterId a, ClusterId b) { return work_.of(a) > work_.of(b); });
  std::vector<double> load(slaves_.size(), 0.0);
  for (Slave& slave : slaves_) slave.holds_cell = false;
  for (const ClusterId c : heaviest_first) {  // each to the slave with the least work so far
    const auto to = std::min_element(load.begin(), load.end());
    *to += work_.of(c);
    slaves_[static_cast<std::size_t>(to - load.begin())].tasks.push_back(c);
  }
  return true;
}

std::optional<ClusterId> CellDealer::task_for(Slave& slave) {
  const auto take = [](std::deque<ClusterId>& tasks, bool first) {
    const ClusterId c = first ? tasks.front() : tasks.back();
    first ? tasks.pop_front() : tasks.pop_back();
    return c;
  };
  if (!slave.tasks.empty()) return take(slave.tasks, true);
  if (!steal_) return std::nullopt;
  const auto victim = std::max_element(
      slaves_.begin(), slaves_.end(),
      [](const Slave& a, const Slave& b) { return a.tasks.size() < b.tasks.size(); });
  if (victim->tasks.empty()) return std::nullopt;
  ++moved_;
  return take(victim->tasks, false);
}

std::optional<WorkOrder> CellDealer::next(Rank rank) {
  Slave& slave = slaves_[static_cast<std::size_t>(rank.value - 1)];
  std::optional<ClusterId> task = task_for(slave);
  while (!task) {
    const bool waiting = std::any_of(slaves_.begin(), slaves_.end(),
                                     [](const Slave& s) { return !s.tasks.empty(); });
    if (waiting || under_way_ > 0) return std::nullopt;
    if (!open_cell()) return WorkOrder{};
    task = task_for(slave);
  }
  ++under_way_;
  WorkOrder order{{*task}, false, {}, {}};
  if (!slave.holds_cell) {
    order.hold = cells_[cell_];
    order.gathered.assign(gathered_.begin() + static_cast<std::ptrdiff_t>(slave.notified),
                          gathered_.end());
    slave.notified = gathered_.size();
    slave.holds_cell = true;
  }
  return order;
}

void CellDealer::done(Rank, const GatherNote& note) {
  --under_way_;
  gathered_.push_back(note.cluster);
  work_.learn(note);
  light_.gathered(note.cluster, note.change_power);
}

}  // namespace enfilade
