#include "store/eviction_order.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

const ClusterId zero(0u), one(1u);

TEST(EvictionOrder, TheFarthestNextUseGoesFirst) {
  EvictionOrder order;
  order.set({{3, false, zero}, {7, false, one}, {5, true, one}}, 100);
  EXPECT_EQ(order.take().turns, 7u);
  EXPECT_EQ(order.take().turns, 5u);
  EXPECT_EQ(order.take().turns, 3u);
  EXPECT_TRUE(order.empty());
}

TEST(EvictionOrder, IsOutOfDateAfterTheEvictionsThatItWasMadeFor) {
  EvictionOrder order;
  EXPECT_TRUE(order.out_of_date());
  order.set({{3, false, zero}}, 100);
  order.note_evicted(99);
  EXPECT_FALSE(order.out_of_date());
  order.note_evicted(5);
  EXPECT_TRUE(order.out_of_date());
  EXPECT_FALSE(order.empty());
}

}  // namespace
}  // namespace enfilade
