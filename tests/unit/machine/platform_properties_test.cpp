#include "machine/platform_properties.hpp"

#include <gmock/gmock.h>

#include "base/error.hpp"

namespace enfilade {
namespace {

using ::testing::HasSubstr;

template <class Read>
std::string refusal(Read read) {
  try {
    read();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(PlatformProperties, OfHosts) {
  const HostProperties server =
      host_properties("nfs", {{"memory", "64M"}, {"serves", "common"}, {"rack", "7"}});
  EXPECT_EQ(server.memory_bytes, std::uint64_t{64} << 20);
  EXPECT_EQ(server.serves, Serves::common);
  EXPECT_EQ(host_properties("h", {{"serves", "alone"}}).serves, Serves::alone);
  EXPECT_EQ(host_properties("h", {}).serves, Serves::nobody);
  EXPECT_EQ(host_properties("h", {}).memory_bytes, 0u);
}

TEST(PlatformProperties, OfDisks) {
  const DiskProperties disk = disk_properties("d", {{"seek_s", "0.009"}, {"background", "0.5"}});
  EXPECT_EQ(disk.seek_s, 0.009);
  EXPECT_EQ(disk.request_s, std::nullopt);
  EXPECT_DOUBLE_EQ(disk.background.end_s(0.0, 1.0), 2.0);
}

TEST(PlatformProperties, FaultsNameTheirPlace) {
  const auto host = [](const char* key, const char* value) {
    return refusal([&] { host_properties("h", {{key, value}}); });
  };
  const auto disk = [](const char* key, const char* value) {
    return refusal([&] { disk_properties("d", {{key, value}}); });
  };
  EXPECT_THAT(host("memroy", "1G"), HasSubstr("host h: memroy: no such property; did you mean"));
  EXPECT_THAT(host("seek_s", "1"), HasSubstr("put it into the host's <disk>"));
  EXPECT_THAT(host("serves", "everybody"), HasSubstr("neither common nor alone"));
  EXPECT_THAT(host("memory", "much"), HasSubstr("host h: memory"));
  EXPECT_THAT(disk("serves", "common"), HasSubstr("put it into the <host>"));
  for (const char* value : {"", "-1", "1s", "nan", "inf", "1e999"})
    EXPECT_THAT(disk("seek_s", value), HasSubstr("disk d: seek_s: '")) << value;
  EXPECT_THAT(disk("background", "2"), HasSubstr("disk d: background"));
}

}  // namespace
}  // namespace enfilade
