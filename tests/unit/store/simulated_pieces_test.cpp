#include "store/simulated_pieces.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

constexpr std::uint64_t page = SimulatedPieces::page_bytes, piece = SimulatedPieces::piece_bytes;

TEST(SimulatedPieces, WhatLiesSideBySideIsOneRange) {
  SimulatedPieces map;
  std::vector<AddressRange> ranges;
  map.take(3 * page + piece, ranges);
  ASSERT_EQ(ranges.size(), 1u);
  EXPECT_EQ(ranges[0].bytes, 3 * page + piece);
  EXPECT_EQ(map.extent_bytes(), 3 * page + piece);
}

TEST(SimulatedPieces, FillsPagesThatHoldOthersBeforeAnEmptyOne) {
  SimulatedPieces map;
  std::vector<AddressRange> first, second, third;
  map.take(2 * page, first);
  map.take(page, second);
  map.free({0, page});                 // page 0 is empty
  map.free({page, page - 2 * piece});  // page 1 holds two pieces
  EXPECT_TRUE(map.page_empty(0));
  EXPECT_FALSE(map.page_empty(1));
  map.take(page - 2 * piece, third);
  ASSERT_EQ(third.size(), 1u);
  EXPECT_EQ(third[0].address, page);
  EXPECT_TRUE(map.page_empty(0));
  map.take(page, third);
  EXPECT_EQ(third[1].address, 0u);
  EXPECT_EQ(map.extent_bytes(), 3 * page) << "no more pages than were full at once";
}

}  // namespace
}  // namespace enfilade
