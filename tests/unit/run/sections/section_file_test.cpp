#include "run/sections/section_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

std::vector<std::byte> some_bytes(std::size_t n) {
  std::vector<std::byte> bytes(n);
  for (std::size_t i = 0; i < n; ++i) bytes[i] = static_cast<std::byte>(i * 7);
  return bytes;
}

void write_section(const std::string& path, const SectionInfo& info,
                   std::span<const std::byte> bytes) {
  write_file(path, section_header(info, bytes), bytes);
}

const SectionPlace links_of_7{ClusterId(7u), Section::links, 3, 99};

std::string fresh_path(const char* name) {
  const std::string path = testing::TempDir() + "/" + name;
  std::filesystem::remove_all(path);
  return path;
}

TEST(SectionFile, ComesBackAsWritten) {
  const std::string path = fresh_path("section");
  const auto bytes = some_bytes(1000);
  write_section(
      path,
      {{ClusterId(7u), Section::patches, 12, 99}, {11, {Rank{3}, 1, 77}}, {1, 2, 3, bytes.size()}},
      bytes);
  const SectionFile file = read_section(path, 0, {ClusterId(7u), Section::patches, 12, 99});
  EXPECT_EQ(file.bytes, bytes);
  EXPECT_EQ(file.info.place.iteration, 12u);
  EXPECT_EQ(file.info.links, (LinksPlace{11, {Rank{3}, 1, 77}}));
  EXPECT_EQ(file.info.count.patches, 2u);
  EXPECT_EQ(file.info.count.bytes, 1000u);
}

TEST(SectionFile, AnyDamagedByteIsFound) {
  const std::string path = fresh_path("damaged");
  const auto bytes = some_bytes(200);
  write_section(path, {links_of_7, {}, {0, 0, 5, bytes.size()}}, bytes);
  const std::vector<std::byte> good = read_file(path);
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::vector<std::byte> bad = good;
    bad[i] ^= std::byte{0x10};
    write_file(path, bad, {});
    EXPECT_THROW(read_section(path, 0, links_of_7), RunError) << "byte " << i;
  }
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{40}, std::size_t{70}, good.size() - 1}) {
    write_file(path, std::span(good).first(size), {});
    EXPECT_THROW(read_section(path, 0, links_of_7), RunError) << "cut at " << size;
  }
}

TEST(SectionFile, SaysWhichFileAndWhatToDo) {
  try {
    read_section("/no/such/dir/rank-1.patches-a.0", 0, {ClusterId(1u), Section::patches});
    FAIL();
  } catch (const RunError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("/no/such/dir/rank-1.patches-a.0"), std::string::npos);
    EXPECT_NE(text.find("; "), std::string::npos);
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

TEST(SectionFile, AFileOfAnotherPlaceIsRefused) {
  const std::string path = fresh_path("others");
  write_section(path, {links_of_7, {}, {}}, some_bytes(3));
  EXPECT_NO_THROW(read_section(path, 0, links_of_7));
  const auto refused = [&](auto change) {
    SectionPlace place = links_of_7;
    change(place);
    EXPECT_THROW(read_section(path, 0, place), RunError);
  };
  refused([](SectionPlace& place) { place.cluster = ClusterId(8u); });
  refused([](SectionPlace& place) { place.section = Section::patches; });
  refused([](SectionPlace& place) { place.iteration -= 1; });
  refused([](SectionPlace& place) { place.run += 1; });
}

}  // namespace
}  // namespace enfilade
