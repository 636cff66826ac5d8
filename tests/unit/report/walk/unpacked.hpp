// The arrays of a walk-through page, read back by code of the tests' own.
#pragma once

#include <zlib.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/walk/binary_arrays.hpp"

namespace enfilade::test {

inline std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 255);
  }
  return bytes;
}

/// IEEE 754, 16 bits.
inline double from_half(std::uint16_t h) {
  const int exponent = h >> 10 & 31, digits = h & 1023;
  const double size =
      exponent == 0 ? std::ldexp(digits, -24) : std::ldexp(1024 + digits, exponent - 25);
  return h & 0x8000 ? -size : size;
}

/// The bytes of each array, in the order of the numbers' own bytes.
inline std::map<std::string, std::string> unpacked(const BinaryArrays& arrays) {
  const std::string packed = decoded(arrays.text());
  std::string data(arrays.bytes(), '\0');
  uLongf size = data.size();
  if (uncompress(reinterpret_cast<Bytef*>(data.data()), &size,
                 reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK)
    return {};
  std::map<std::string, std::string> found;
  std::size_t at = 0;
  for (const auto& entry : arrays.list()) {
    const std::size_t width = entry["bytes"], length = entry["length"];
    std::string& bytes = found[entry["name"]];
    for (std::size_t i = 0; i < length; ++i) {
      for (std::size_t plane = 0; plane < width; ++plane) bytes += data[at + plane * length + i];
    }
    at += (width * length + 3) / 4 * 4;
  }
  return found;
}

template <class T>
std::vector<T> numbers(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace enfilade::test
