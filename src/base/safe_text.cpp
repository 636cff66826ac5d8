#include "base/safe_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace enfilade {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool valid = false;  ///< else `code` is the first byte, and it is no UTF-8
};

Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  Character c{lead, 1, lead < 0x80};
  if (c.valid) return c;
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return c;
  std::uint32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return c;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < least[bytes] || code > 0x10FFFF || surrogate) return c;
  return {code, bytes, true};
}

/// Control characters (C0, DEL, C1), direction marks, separators, and the byte order mark.
bool acts(std::uint32_t code) {
  constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 7> ranges = {{{0x00, 0x1F},
                                                                              {0x7F, 0x9F},
                                                                              {0x061C, 0x061C},
                                                                              {0x200E, 0x200F},
                                                                              {0x2028, 0x202E},
                                                                              {0x2066, 0x2069},
                                                                              {0xFEFF, 0xFEFF}}};
  return std::any_of(ranges.begin(), ranges.end(), [code](const auto& range) {
    return code >= range.first && code <= range.second;
  });
}

}  // namespace

std::string safe_text(std::string_view text, std::string_view kept,
                      const std::function<std::string(std::uint32_t)>& shown) {
  std::string safe;
  safe.reserve(text.size());
  while (!text.empty()) {
    const Character c = first_of(text);
    const bool keep = kept.find(text.front()) != std::string_view::npos;
    if (keep || (c.valid && !acts(c.code))) {
      safe += text.substr(0, c.bytes);
    } else {
      safe += shown(c.code);
    }
    text.remove_prefix(c.bytes);
  }
  return safe;
}

std::string terminal_text(std::string_view text) {
  return safe_text(text, "\n\t", [](std::uint32_t code) {
    char digits[12];
    std::snprintf(digits, sizeof digits, code < 0x100 ? "\\x%02x" : "\\u%04x", code);
    return std::string(digits);
  });
}

std::string on_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool blank = c == '\n' || c == '\r' || c == '\t';
    if (!blank)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::string file_text(std::string_view text) {
  return safe_text(text, "\n\t", [](std::uint32_t) { return std::string("\xEF\xBF\xBD"); });
}

std::string csv_field(std::string_view text) {
  std::string safe = file_text(text);
  if (!safe.empty() && std::string_view("=+-@\t").find(safe.front()) != std::string_view::npos)
    safe.insert(0, 1, '\'');
  if (safe.find_first_of(",\"\r\n") == std::string::npos) return safe;
  std::string quoted = "\"";
  for (const char c : safe) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace enfilade
