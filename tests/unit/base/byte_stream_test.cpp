#include "base/byte_stream.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace enfilade {
namespace {

struct Pair {
  std::int32_t a;
  std::uint32_t b;
  bool operator==(const Pair&) const = default;
};

struct Padded {
  std::uint32_t a;
  std::uint64_t b;
};
static_assert(PlainValue<Pair> && PlainValue<double> && PlainValue<glm::dvec3>);
static_assert(!PlainValue<Padded>, "its padding would be written");

std::vector<std::byte> sample() {
  ByteWriter out;
  out.put_mark("mark");
  out.put(-7);
  out.put_text("a name");
  out.put_all(std::vector<Pair>{{1, 5}, {-2, 4}});
  out.put_all<std::uint32_t>(std::vector<double>{1.5});
  out.put_all(std::vector<double>{});
  return out.take();
}

void read_sample(std::span<const std::byte> bytes) {
  ByteReader in(bytes, "the sample");
  in.expect("mark");
  EXPECT_EQ(in.get<int>(), -7);
  EXPECT_EQ(in.get_text(), "a name");
  EXPECT_EQ(in.get_all<Pair>(), (std::vector<Pair>{{1, 5}, {-2, 4}}));
  EXPECT_EQ((in.get_all<double, std::uint32_t>()), std::vector<double>{1.5});
  EXPECT_TRUE(in.get_all<double>().empty());
  in.expect_end();
}

std::string error_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const RunError& error) {
    return error.what();
  }
  return "";
}

TEST(ByteStream, GivesBackWhatWasPut) { read_sample(sample()); }

TEST(ByteStream, PacksWithoutGaps) {
  EXPECT_EQ(sample().size(), 4u + 4 + (8 + 6) + (8 + 2 * 8) + (4 + 8) + 8);
}

TEST(ByteStream, TextAndBytesAreTheSame) {
  ByteWriter out;
  out.put_text("abc");
  const std::string text = out.text();
  EXPECT_EQ(text.size(), 11u);
  EXPECT_EQ(ByteReader(std::string_view(text), "text").get_text(), "abc");
}

TEST(ByteStream, RefusesEveryCut) {
  std::vector<std::byte> bytes = sample();
  while (!bytes.empty()) {
    bytes.pop_back();
    EXPECT_EQ(error_of([&] { read_sample(bytes); }), "the sample: cut off") << bytes.size();
  }
}

TEST(ByteStream, RefusesMoreThanItExpects) {
  std::vector<std::byte> bytes = sample();
  bytes.push_back(std::byte{0});
  EXPECT_EQ(error_of([&] { read_sample(bytes); }), "the sample: longer than it should be");
}

TEST(ByteStream, RefusesAnotherMark) {
  EXPECT_EQ(error_of([] { ByteReader(std::string_view("mark-1"), "file").expect("mark-2"); }),
            "file: not of this version");
}

TEST(ByteStream, RefusesCountsThatCannotBeBeforeItTakesMemory) {
  for (const std::uint64_t count :
       {std::uint64_t{2}, std::uint64_t{1} << 61, std::numeric_limits<std::uint64_t>::max()}) {
    ByteWriter out;
    out.put(count);
    out.put(1.0);  // room for one
    const std::vector<std::byte> bytes = out.take();
    EXPECT_EQ(error_of([&] { ByteReader(bytes, "file").get_all<double>(); }), "file: cut off");
    EXPECT_EQ(error_of([&] { ByteReader(bytes, "file").get_count(8); }), "file: cut off");
  }
}

}  // namespace
}  // namespace enfilade
