#include "base/smaller_parts.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace enfilade {
namespace {

struct Part {
  std::vector<std::uint32_t> nodes, queue;  ///< the queue: found, their neighbours not looked at
  double size = 0.0;
};

class PartSearch {
 public:
  PartSearch(std::span<const std::uint32_t> starts, const PartGraph& graph) : graph_(graph) {
    for (const std::uint32_t start : starts) {
      if (part_of_.contains(start)) continue;
      parts_.emplace_back();
      take(start, parts_.size() - 1);
    }
  }

  std::vector<std::uint32_t> run() {
    while (Part* part = next()) expand(*part);
    const auto largest = std::max_element(
        parts_.begin(), parts_.end(), [](const Part& a, const Part& b) { return a.size < b.size; });
    std::vector<std::uint32_t> found;
    for (auto part = parts_.begin(); part != parts_.end(); ++part) {
      if (part != largest) found.insert(found.end(), part->nodes.begin(), part->nodes.end());
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  /// Returns the unfinished part of the fewest nodes; null where all are finished, or where the
  /// last one is larger than all others.
  Part* next() {
    Part *fewest = nullptr, *other = nullptr;
    double finished = 0.0, largest = 0.0;
    for (Part& part : parts_) {
      if (part.queue.empty()) {
        finished += part.size;
        largest = std::max(largest, part.size);
      } else if (fewest == nullptr || part.nodes.size() < fewest->nodes.size()) {
        other = fewest;
        fewest = &part;
      } else {
        other = &part;
      }
    }
    if (fewest == nullptr || other != nullptr) return fewest;
    const double rest = graph_.whole - finished;
    if (rest <= largest) return fewest;
    fewest->size = rest;
    return nullptr;
  }

  void take(std::uint32_t node, std::size_t part) {
    part_of_[node] = part;
    parts_[part].nodes.push_back(node);
    parts_[part].queue.push_back(node);
    parts_[part].size += graph_.size(node);
  }

  void expand(Part& part) {
    const std::uint32_t node = part.queue.back();
    part.queue.pop_back();
    graph_.neighbours(node, [&](std::uint32_t neighbour) {
      const auto known = part_of_.find(neighbour);
      const std::size_t own = part_of_[node];
      if (known == part_of_.end()) {
        take(neighbour, own);
      } else if (known->second != own) {
        join(known->second, own);
      }
    });
  }

  /// Moves the part of fewer nodes into the other.
  void join(std::size_t a, std::size_t b) {
    if (parts_[a].nodes.size() < parts_[b].nodes.size()) std::swap(a, b);
    for (const std::uint32_t node : parts_[b].nodes) part_of_[node] = a;
    Part& to = parts_[a];
    Part from = std::exchange(parts_[b], {});
    to.nodes.insert(to.nodes.end(), from.nodes.begin(), from.nodes.end());
    to.queue.insert(to.queue.end(), from.queue.begin(), from.queue.end());
    to.size += from.size;
  }

  const PartGraph& graph_;
  std::vector<Part> parts_;  ///< one that has joined another is empty
  std::unordered_map<std::uint32_t, std::size_t> part_of_;
};

}  // namespace

std::vector<std::uint32_t> smaller_parts(std::span<const std::uint32_t> starts,
                                         const PartGraph& graph) {
  return PartSearch(starts, graph).run();
}

}  // namespace enfilade
