#include "store/eviction_order.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

const ClusterId cluster_0(0u), cluster_1(1u);

TEST(EvictionOrder, TheFarthestNextUseGoesFirst) {
  EvictionOrder order;
  order.set({{3, false, cluster_0}, {7, false, cluster_1}, {5, true, cluster_1}}, 100);
  EXPECT_EQ(order.take().turns, 7u);
  EXPECT_EQ(order.take().turns, 5u);
  EXPECT_EQ(order.take().turns, 3u);
  EXPECT_TRUE(order.empty());
}

TEST(EvictionOrder, IsOutOfDateAfterTheEvictionsThatItWasMadeFor) {
  EvictionOrder order;
  EXPECT_TRUE(order.out_of_date());
  order.set({{3, false, cluster_0}}, 100);
  order.note_evicted(99);
  EXPECT_FALSE(order.out_of_date());
  order.note_evicted(5);
  EXPECT_TRUE(order.out_of_date());
  EXPECT_FALSE(order.empty());
}

}  // namespace
}  // namespace enfilade
