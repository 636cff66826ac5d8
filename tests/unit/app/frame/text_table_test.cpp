#include "app/frame/text_table.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(TextTable, AlignsValuesAfterTheLongestLabel) {
  TextTable table("run");
  table.add("a", "1");
  table.add("label", "two");
  EXPECT_EQ(table.text(), "run\n  a      1\n  label  two\n");
}

TEST(TextTable, ThousandsStandInThrees) {
  EXPECT_EQ(with_thousands(0), "0");
  EXPECT_EQ(with_thousands(999), "999");
  EXPECT_EQ(with_thousands(1000), "1,000");
  EXPECT_EQ(with_thousands(1234567890), "1,234,567,890");
}

TEST(TextTable, DurationsReadNaturally) {
  EXPECT_EQ(format_duration(0.424), "0.42 s");
  EXPECT_EQ(format_duration(59.4), "59 s");
  EXPECT_EQ(format_duration(75.0), "1 min 15 s");
  EXPECT_EQ(format_duration(4020.0), "1 h 07 min");
}

TEST(TextTable, BytesArePowersOf1024) {
  EXPECT_EQ(format_bytes(1023), "1023 B");
  EXPECT_EQ(format_bytes(1536), "1.5 KiB");
  EXPECT_EQ(format_bytes(512.0 * 1024 * 1024), "512 MiB");
}

}  // namespace
}  // namespace enfilade
