#include "json/text_encoding.hpp"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "base/error.hpp"

namespace enfilade {

std::string in_utf8(std::string_view bytes, const char* encoding) {
  const iconv_t converter = ::iconv_open("UTF-8", encoding);
  ENFILADE_CHECK(converter != reinterpret_cast<iconv_t>(-1), encoding);
  std::string text, from_bytes(bytes);
  std::array<char, 4096> chunk;
  char* from = from_bytes.data();
  std::size_t left = from_bytes.size();
  while (left > 0) {
    char* to = chunk.data();
    std::size_t room = chunk.size();
    const bool done = ::iconv(converter, &from, &left, &to, &room) != static_cast<std::size_t>(-1);
    const int error = done ? 0 : errno;
    text.append(chunk.data(), chunk.size() - room);
    if (error == EINVAL) break;  // the file ends within a character
    if (error == EILSEQ) {
      const std::size_t skipped = std::min<std::size_t>(left, 2);
      from += skipped;
      left -= skipped;
    }
  }
  ::iconv_close(converter);
  return text;
}

const char* utf16_by_mark(std::string_view bytes) {
  const std::string_view mark = bytes.substr(0, 2);
  return mark == "\xFF\xFE" ? "UTF-16LE" : mark == "\xFE\xFF" ? "UTF-16BE" : nullptr;
}

std::string file_in_utf8(std::string bytes) {
  const char* const encoding = utf16_by_mark(bytes);
  return encoding == nullptr ? bytes : in_utf8(std::string_view(bytes).substr(2), encoding);
}

}  // namespace enfilade
