#include "schemes/protocol/messages.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

TEST(Messages, ComeBackAsTheyWereSent) {
  RankSet idle;
  idle.add(Rank{70});
  const StealRequest request{3, {ClusterId(5), ClusterId(70000)}, idle};
  const auto r = std::get<StealRequest>(decode(Tag::steal_request, encode(request)));
  EXPECT_EQ(r.iteration, 3);
  EXPECT_EQ(r.resident, request.resident);
  EXPECT_TRUE(r.idle.has(Rank{70}));
  EXPECT_FALSE(r.idle.has(Rank{6}));

  const auto none = std::get<StealReply>(decode(Tag::steal_reply, encode(StealReply{{}, idle})));
  EXPECT_FALSE(none.cluster.valid());
  EXPECT_TRUE(none.idle.has(Rank{70}));

  const auto token = std::get<Token>(decode(Tag::token, encode(Token{{1.5}, {2.5, -3.0}, {9.0}})));
  EXPECT_EQ(token.maxima, (std::vector<double>{1.5}));
  EXPECT_EQ(token.sums, (std::vector<double>{2.5, -3.0}));
  EXPECT_EQ(token.coarse, (std::vector<double>{9.0}));

  const auto decision =
      std::get<Decision>(decode(Tag::decision, encode(Decision{-1.0, {4.0}, {5.0}})));
  EXPECT_EQ(decision.value, -1.0);
  EXPECT_EQ(decision.plan, (std::vector<double>{4.0}));
  EXPECT_EQ(decision.correction, (std::vector<double>{5.0}));
}

TEST(Messages, OfAMasterAndItsSlavesComeBackAsTheyWereSent) {
  const Message request = WorkRequest{{{ClusterId(3), 1.5, 12}}};
  const auto r = std::get<WorkRequest>(decode(tag_of(request), encode(request)));
  EXPECT_EQ(r.done.at(0).cluster, ClusterId(3));
  EXPECT_EQ(r.done.at(0).change_power, 1.5);
  EXPECT_EQ(r.done.at(0).links, 12u);

  const Message order = WorkOrder{{ClusterId(1)}, true, {ClusterId(2)}, {ClusterId(4)}};
  const auto o = std::get<WorkOrder>(decode(tag_of(order), encode(order)));
  EXPECT_EQ(o.gather, (std::vector<ClusterId>{ClusterId(1)}));
  EXPECT_TRUE(o.hold_each);
  EXPECT_EQ(o.hold, (std::vector<ClusterId>{ClusterId(2)}));
  EXPECT_EQ(o.gathered, (std::vector<ClusterId>{ClusterId(4)}));

  const Message wanted = SectionRequest{{{ClusterId(7), Section::patches, true}}};
  EXPECT_EQ(std::get<SectionRequest>(decode(tag_of(wanted), encode(wanted))).sections.at(0),
            (SectionName{ClusterId(7), Section::patches, true}));

  const SectionFile file{{{ClusterId(7), Section::links, 5, 6}, {4, {Rank{2}, 1, 8}}, {1, 2, 3, 4}},
                         {std::byte{9}, std::byte{8}}};
  for (const Message& message :
       {Message(SectionReply{{file, file}}), Message(ClusterResult{{file}})}) {
    const Message copy = decode(tag_of(message), encode(message));
    ASSERT_EQ(copy.index(), message.index());
    const auto* reply = std::get_if<SectionReply>(&copy);
    const SectionFile& back =
        reply ? reply->sections.at(1) : std::get<ClusterResult>(copy).sections.at(0);
    EXPECT_EQ(back.info.place, file.info.place);
    EXPECT_EQ(back.info.links, file.info.links);
    EXPECT_EQ(back.info.count.links, 3u);
    EXPECT_EQ(back.bytes, file.bytes);
  }
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
