#include "comm/messages.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

TEST(Messages, ComeBackAsTheyWereSent) {
  const StealRequest request{3, {ClusterId(5), ClusterId(70000)}};
  const auto r = std::get<StealRequest>(decode(Tag::steal_request, encode(request)));
  EXPECT_EQ(r.iteration, 3);
  EXPECT_EQ(r.resident, request.resident);

  const auto none = std::get<StealReply>(decode(Tag::steal_reply, encode(StealReply{})));
  EXPECT_FALSE(none.cluster.valid());

  const auto token = std::get<Token>(decode(Tag::token, encode(Token{{1.5}, {2.5, -3.0}, {9.0}})));
  EXPECT_EQ(token.maxima, (std::vector<double>{1.5}));
  EXPECT_EQ(token.sums, (std::vector<double>{2.5, -3.0}));
  EXPECT_EQ(token.coarse, (std::vector<double>{9.0}));

  const auto verdict = std::get<Verdict>(decode(Tag::verdict, encode(Verdict{-1.0, {4.0}, {5.0}})));
  EXPECT_EQ(verdict.value, -1.0);
  EXPECT_EQ(verdict.plan, (std::vector<double>{4.0}));
  EXPECT_EQ(verdict.correction, (std::vector<double>{5.0}));
}

TEST(Messages, AreRefusedWhenTheyAreCutOrTooLongOrUnknown) {
  auto bytes = encode(Token{{1.0}, {2.0, 3.0}, {4.0}});
  auto longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_THROW(decode(Tag::token, longer), RunError);
  while (!bytes.empty()) {
    bytes.pop_back();
    EXPECT_THROW(decode(Tag::token, bytes), RunError) << bytes.size();
  }
  EXPECT_THROW(decode(static_cast<Tag>(99), longer), RunError);
}

}  // namespace
}  // namespace enfilade
