// A 64-bit hash as files and records name it: 16 hexadecimal digits.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace enfilade {

inline std::string hash_text(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

/// Returns the hash that such a text names. Throws std::logic_error for any other text.
inline std::uint64_t hash_from_text(const std::string& text) {
  return std::stoull(text, nullptr, 16);
}

}  // namespace enfilade
