#include "hierarchy/cluster_codec.hpp"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

Link some_link(std::uint32_t i) {
  Link link;
  link.shooter_cluster = ClusterId(i);
  link.shooter = {i + 1, i + 2};
  link.receiver = {PatchId::group_bit + i, 1};
  link.shooter_x = 0.5f * static_cast<float>(i);
  link.shooter_y = -1.5f;
  link.error = 0.25f;
  link.variation = 0.125f;
  link.evaluated = i % 2 != 0;
  link.finest = i % 4 >= 2;
  link.visibility_uncertainty = static_cast<std::uint8_t>(200 + i);
  return link;
}

TEST(ClusterCodec, LinksSurvive) {
  LinkSet links(4);
  for (std::uint32_t i = 0; i < 4; ++i)
    links.add(some_link(i), std::vector<float>(4, static_cast<float>(i)),
              i == 2 ? std::vector<double>{1.0, 0.25} : std::vector<double>{});
  ByteWriter w;
  ClusterCodec::write_links(links, w);
  const std::vector<std::byte> bytes = w.take();
  ByteReader r(bytes, "links");
  const LinkSet copy = ClusterCodec::read_links(r, 4);
  r.expect_end();
  ASSERT_EQ(copy.size(), links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link &a = links[i], &b = copy[i];
    EXPECT_EQ(b.shooter_cluster, a.shooter_cluster);
    EXPECT_EQ(b.shooter, a.shooter);
    EXPECT_EQ(b.receiver, a.receiver);
    EXPECT_EQ(b.shooter_x, a.shooter_x);
    EXPECT_EQ(b.shooter_y, a.shooter_y);
    EXPECT_EQ(b.error, a.error);
    EXPECT_EQ(b.variation, a.variation);
    EXPECT_EQ(b.evaluated, a.evaluated);
    EXPECT_EQ(b.finest, a.finest);
    EXPECT_EQ(b.visibility_uncertainty, a.visibility_uncertainty);
    EXPECT_EQ(copy.transport(i)[3], links.transport(i)[3]);
    ASSERT_EQ(copy.tint(i).size(), 2u);
    EXPECT_EQ(copy.tint(i)[0], 1.0f);
    EXPECT_EQ(copy.tint(i)[1], i == 2 ? 0.25f : 1.0f);
  }
  LinkSet some(4);
  some.take_first(copy, 1);
  some.add_from(copy, 2);
  EXPECT_EQ(some.tint(0)[1], 1.0f);
  EXPECT_EQ(some.tint(1)[1], 0.25f);
}

TEST(ClusterCodec, ALinkIsWrittenWithoutPadding) {
  LinkSet links(1);
  links.add(some_link(3), std::vector<float>{1.0f});
  ByteWriter w;
  ClusterCodec::write_links(links, w);
  const std::vector<std::byte> bytes = w.take();
  const std::size_t record = 5 * 4 + 4 * 4 + 2, before = 8 + 8, after = 8 + 4 + 8 + 8;
  ASSERT_EQ(bytes.size(), before + record + after);
  EXPECT_EQ(bytes[before], std::byte{3});  // the shooter's cluster, least significant byte first
  EXPECT_EQ(bytes[before + 1], std::byte{0});
  EXPECT_EQ(bytes[before + record - 2], std::byte{3});  // evaluated and finest
  EXPECT_EQ(bytes[before + record - 1], std::byte{203});
}

TEST(ClusterCodec, RefusesMoreLinksThanThereAreBytes) {
  ByteWriter w;
  w.put(std::uint64_t{1});
  w.put(std::uint64_t{1} << 40);
  const std::vector<std::byte> bytes = w.take();
  ByteReader r(bytes, "links");
  EXPECT_THROW(ClusterCodec::read_links(r, 1), RunError);
}

}  // namespace
}  // namespace enfilade
