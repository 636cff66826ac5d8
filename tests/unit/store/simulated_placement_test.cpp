#include "store/simulated_placement.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "base/random.hpp"

namespace enfilade {
namespace {

constexpr std::uint64_t page_size = SimulatedPlacement::page_bytes;

TEST(SimulatedPlacement, KnowsItsNames) {
  EXPECT_EQ(memory_manager("own"), MemoryManager::own);
  EXPECT_EQ(memory_manager("malloc"), MemoryManager::malloc);
  EXPECT_THROW(memory_manager("jemalloc"), InputError);
}

/// Ten blocks of four pages; every other one is dropped; then one of eight pages comes.
SimulatedPlacement after_a_hole_too_small(MemoryManager manager) {
  SimulatedPlacement placement(manager, 40 * page_size);
  std::vector<SimulatedPlacement::Block> blocks(10, 0);
  for (auto& block : blocks) placement.resize(block, 4 * page_size - 16);
  for (std::size_t i = 0; i < 10; i += 2) placement.resize(blocks[i], 0);
  SimulatedPlacement::Block large = 0;
  placement.resize(large, 8 * page_size - 16);
  return placement;
}

TEST(SimulatedPlacement, PiecesFillHolesThatAHeapCannot) {
  EXPECT_EQ(after_a_hole_too_small(MemoryManager::own).count().extent_bytes, 40 * page_size);
  EXPECT_EQ(after_a_hole_too_small(MemoryManager::own).count().swapped_bytes, 0u);
  const SimulatedPlacementCount heap = after_a_hole_too_small(MemoryManager::malloc).count();
  EXPECT_EQ(heap.extent_bytes, 48 * page_size)
      << "20 pages are free, and none of the holes has eight";
  EXPECT_GE(heap.swapped_bytes, 8 * page_size) << "the holes are dirty, and have to make room";
}

TEST(SimulatedPlacement, AHeapTakesTheSmallestHoleAndJoinsNeighbours) {
  SimulatedPlacement heap(MemoryManager::malloc, 1 << 30);
  std::vector<SimulatedPlacement::Block> blocks(5, 0);
  for (const std::size_t i : {0u, 1u, 2u, 3u, 4u}) heap.resize(blocks[i], i == 1 ? 2000 : 1000);
  const std::uint64_t extent = heap.count().extent_bytes;
  heap.resize(blocks[1], 0);
  heap.resize(blocks[3], 0);
  SimulatedPlacement::Block small = 0, large = 0;
  heap.resize(small, 1000);
  heap.resize(large, 2000);
  EXPECT_EQ(heap.count().extent_bytes, extent) << "each has a hole of its size";
  heap.resize(large, 0);
  heap.resize(blocks[2], 0);
  heap.resize(large, 3000);
  EXPECT_EQ(heap.count().extent_bytes, extent) << "two holes side by side are one";
}

TEST(SimulatedPlacement, WhatIsFreeAtTheEndGoesBack) {
  SimulatedPlacement heap(MemoryManager::malloc, 10 * page_size);
  for (int i = 0; i < 100; ++i) {
    SimulatedPlacement::Block block = 0;
    heap.resize(block, 9 * page_size);
    heap.resize(block, 0);
  }
  EXPECT_EQ(heap.count().swapped_bytes, 0u);
  EXPECT_LE(heap.count().extent_bytes, 10 * page_size);
}

TEST(SimulatedPlacement, SwapsWhatWasNotUsedForLongest) {
  SimulatedPlacement placement(MemoryManager::own, 3 * page_size);
  std::vector<SimulatedPlacement::Block> blocks(4, 0);
  for (std::size_t i = 0; i < 3; ++i) placement.resize(blocks[i], page_size);
  placement.use(blocks[0]);
  placement.resize(blocks[3], page_size);  // 1 has to go
  EXPECT_EQ(placement.count().swapped_bytes, page_size);
  EXPECT_EQ(placement.use(blocks[0]), 0u);
  EXPECT_EQ(placement.use(blocks[2]), 0u);
  EXPECT_EQ(placement.use(blocks[1]), 2 * page_size) << "in again, and 3 out";
}

TEST(SimulatedPlacement, OwnPiecesNeverTakeMoreThanTheBlocksDo) {
  Random random(7);
  SimulatedPlacement own(MemoryManager::own, 1000 * page_size);
  std::vector<SimulatedPlacement::Block> blocks(50, 0);
  std::vector<std::uint64_t> accounted(50, 0);
  std::uint64_t live = 0, most = 0;
  for (int step = 0; step < 5000; ++step) {
    const std::size_t i = random.below(blocks.size());
    const std::uint64_t bytes = random.below(20 * page_size);
    const std::uint64_t taken = own.accounted(bytes);
    most = std::max(most, live + taken);  // the new place is taken before the old one is left
    live += taken - accounted[i];
    accounted[i] = taken;
    own.resize(blocks[i], bytes);
  }
  EXPECT_LE(own.count().extent_bytes, most);
  EXPECT_EQ(own.count().swapped_bytes, 0u);
}

}  // namespace
}  // namespace enfilade
