#include "base/run_record.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(RunRecord, KeepsOrderAndReplaces) {
  RunRecord r;
  r.set("b", 1);
  r.set("a", 2.5);
  r.set("b", "word");
  ASSERT_EQ(r.entries().size(), 2u);
  EXPECT_EQ(r.entries()[0].first, "b");
  EXPECT_EQ(std::get<std::string>(*r.find("b")), "word");
  EXPECT_EQ(r.number("a", 0.0), 2.5);
  EXPECT_EQ(r.number("c", -1.0), -1.0);
}

}  // namespace
}  // namespace enfilade
