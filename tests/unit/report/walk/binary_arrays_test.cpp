#include "report/walk/binary_arrays.hpp"

#include <gtest/gtest.h>

#include "unit/report/walk/unpacked.hpp"

namespace enfilade {
namespace {

TEST(BinaryArrays, ComeBackAsTheyWere) {
  const std::vector<float> floats{1.5f, -2.25f, 1e-20f, 3e8f};
  const std::vector<std::uint8_t> bytes{1, 2, 255};
  const std::vector<std::uint16_t> shorts{1, 65535, 256};
  const std::vector<std::uint32_t> longs{7, 0xDEADBEEFu};
  BinaryArrays arrays;
  arrays.add("floats", floats);
  arrays.add("bytes", bytes);
  arrays.add("shorts", shorts);
  arrays.add("none", std::vector<float>{});
  arrays.add("longs", longs);
  auto found = test::unpacked(arrays);
  EXPECT_EQ(test::numbers<float>(found["floats"]), floats);
  EXPECT_EQ(test::numbers<std::uint8_t>(found["bytes"]), bytes);
  EXPECT_EQ(test::numbers<std::uint16_t>(found["shorts"]), shorts);
  EXPECT_TRUE(found["none"].empty());
  EXPECT_EQ(test::numbers<std::uint32_t>(found["longs"]), longs);
}

TEST(HalfFloat, IsTheNearestOfIeee754) {
  EXPECT_EQ(half_float(1.0), 0x3C00);
  EXPECT_EQ(half_float(-2.0), 0xC000);
  EXPECT_EQ(half_float(65504.0), 0x7BFF);
  EXPECT_EQ(half_float(0.0), 0x0000);
  for (double value = 6.2e-5; value < 65504.0; value *= 1.0037) {
    EXPECT_NEAR(test::from_half(half_float(value)), value, value / 2048.0);
    EXPECT_NEAR(test::from_half(half_float(-value)), -value, value / 2048.0);
  }
  for (double value = 1e-9; value < 6.1e-5; value *= 1.37)
    EXPECT_NEAR(test::from_half(half_float(value)), value, 3.0e-8);
}

}  // namespace
}  // namespace enfilade
