#include "photometry/files/photometric_text.hpp"

#include <charconv>
#include <cmath>

#include "json/text_encoding.hpp"

namespace enfilade {
namespace {

bool is_utf8(std::string_view text) {
  int more = 0;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (more > 0) {
      if ((u & 0xC0) != 0x80) return false;
      --more;
    } else if (u >= 0x80) {
      more = (u & 0xE0) == 0xC0 ? 1 : (u & 0xF0) == 0xE0 ? 2 : (u & 0xF8) == 0xF0 ? 3 : -1;
      if (more < 0) return false;
    }
  }
  return more == 0;
}

/// In UTF-16 nearly every other byte of such a file is zero.
const char* utf16_without_mark(std::string_view bytes) {
  std::size_t even = 0, odd = 0;
  const std::size_t looked = std::min<std::size_t>(bytes.size(), 512);
  for (std::size_t i = 0; i < looked; ++i)
    if (bytes[i] == '\0') ++(i % 2 == 0 ? even : odd);
  if (odd * 4 > looked) return "UTF-16LE";
  return even * 4 > looked ? "UTF-16BE" : nullptr;
}

}  // namespace

std::string photometric_text(const std::string& bytes, PhotometricReport& report) {
  const std::string_view all(bytes);
  std::string text;
  const char* const mark = utf16_by_mark(all);
  const char* const utf16 = mark != nullptr ? mark : utf16_without_mark(all);
  if (utf16 != nullptr) {
    report.warn("is UTF-16: read so; these formats are plain text (ASCII)");
    text = in_utf8(all.substr(mark != nullptr ? 2 : 0), utf16);
  } else if (all.substr(0, 3) == "\xEF\xBB\xBF") {
    report.warn("begins with a byte order mark (UTF-8): passed over");
    text = bytes.substr(3);
  } else {
    text = bytes;
  }
  if (!is_utf8(text)) text = in_utf8(text, "ISO-8859-1");
  if (const std::size_t end = text.find('\x1A'); end != std::string::npos) text.resize(end);
  std::erase(text, '\0');
  return text;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' || text[i] == '\n') {
      if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') ++i;
      lines.emplace_back();
    } else {
      lines.back() += text[i] == '\t' || text[i] == '\f' || text[i] == '\v' ? ' ' : text[i];
    }
  }
  for (std::string& line : lines) {
    line.erase(0, std::min(line.find_first_not_of(' '), line.size()));
    line.resize(line.find_last_not_of(' ') + 1);
  }
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

bool number_of(std::string_view word, double& value) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  if (word.empty()) return false;
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  return code == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

NumberList numbers_from(const std::vector<std::string>& lines, std::size_t first, Comma comma) {
  NumberList list;
  for (std::size_t i = first; i < lines.size(); ++i) {
    std::string line = lines[i];
    for (char& c : line) {
      if (c == ',') c = comma == Comma::decimal ? '.' : ' ';
    }
    for (std::size_t at = line.find_first_not_of(' '); at != std::string::npos;) {
      const std::size_t end = std::min(line.find(' ', at), line.size());
      double value = 0.0;
      const std::string word = line.substr(at, end - at);
      if (!number_of(word, value)) {
        list.odd_line = i + 1;
        list.odd_word = word.substr(0, 24);
        return list;
      }
      list.numbers.push_back({value, i + 1});
      at = line.find_first_not_of(' ', end);
    }
  }
  return list;
}

}  // namespace enfilade
