#include "base/byte_stream.hpp"

namespace enfilade {

void ByteWriter::put_text(std::string_view text) {
  put(static_cast<std::uint64_t>(text.size()));
  put_mark(text);
}

std::string ByteWriter::text() const {
  return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
}

void ByteWriter::add(std::span<const std::byte> raw) {
  bytes_.insert(bytes_.end(), raw.begin(), raw.end());
}

std::string ByteReader::get_text() {
  const std::size_t size = get_count(1);
  return {reinterpret_cast<const char*>(advance(size)), size};
}

void ByteReader::expect(std::string_view mark) {
  if (std::memcmp(advance(mark.size()), mark.data(), mark.size()) != 0)
    throw RunError(what_ + ": not of this version");
}

void ByteReader::expect_end() const {
  if (!bytes_.empty()) throw RunError(what_ + ": longer than it should be");
}

void ByteReader::cut_off() const { throw RunError(what_ + ": cut off"); }

const std::byte* ByteReader::advance(std::size_t size) {
  if (size > bytes_.size()) cut_off();
  const std::byte* at = bytes_.data();
  bytes_ = bytes_.subspan(size);
  return at;
}

}  // namespace enfilade
