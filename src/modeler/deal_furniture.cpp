// Deals a storey's furniture over its spaces: one to each that has a place, then a second, ...
#include <numeric>

#include "base/error.hpp"
#include "base/random.hpp"
#include "modeler/furnishing.hpp"

namespace enfilade {
namespace {

std::vector<Space> spaces_of(const BuildingPlan& plan) {
  std::vector<Space> spaces;
  for (const Bay& bay : plan.bays) {
    const auto left = bay.stairs ? Space::Kind::stairs : Space::Kind::room;
    spaces.push_back({Space::Kind::corridor, bay.index});
    spaces.push_back({left, bay.index, BaySide::left});
    spaces.push_back({Space::Kind::room, bay.index, BaySide::right});
  }
  return spaces;
}

std::vector<std::size_t> shuffled(std::size_t count, Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

/// Of the `wanted` of a kind, how many found no place.
int deal(const Building& building, const BuildingPlan& plan, std::vector<Space>& spaces,
         FurnitureKind kind, int wanted, Random& random) {
  for (bool placed = true; placed && wanted > 0;) {
    placed = false;
    for (const std::size_t i : shuffled(spaces.size(), random)) {
      Space& space = spaces[i];
      int& has = space.has[index_of(kind)];
      if (wanted == 0 || has >= places_for(building, plan, space, kind)) continue;
      // One a round, so that no space has two while another that has place has none.
      ++has;
      --wanted;
      placed = true;
    }
  }
  return wanted;
}

}  // namespace

std::vector<Space> deal_furniture(const Building& building, const BuildingPlan& plan,
                                  const ModelStorey& storey) {
  std::vector<Space> spaces = spaces_of(plan);
  Random random(static_cast<std::uint64_t>(building.seed) * 1000003u +
                static_cast<std::uint64_t>(storey.number));
  for (std::size_t k = 0; k < furniture_kinds; ++k) {
    const auto kind = static_cast<FurnitureKind>(k);
    const int wanted =
        building.furniture[k] + (storey.number == 0 ? building.ground_furniture[k] : 0);
    const int left = deal(building, plan, spaces, kind, wanted, random);
    if (left == 0) continue;
    const bool ground = building.furniture[k] <= wanted - left;
    throw building.fault(std::string(ground ? "ground_furniture." : "furniture.") + name_of(kind),
                         "asks for " + std::to_string(wanted) +
                             " on a storey, which has place for " + std::to_string(wanted - left),
                         "ask for fewer, or make more rooms (monitors and desk lamps need desks)");
  }
  return spaces;
}

}  // namespace enfilade
