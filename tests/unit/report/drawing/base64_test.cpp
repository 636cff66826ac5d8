#include "report/drawing/base64.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(Base64, IsThatOfRfc4648) {
  // Section 10, test vectors; and bytes above 127.
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfe\x00\xfb", 4)), "//4A+w==");
}

}  // namespace
}  // namespace enfilade
