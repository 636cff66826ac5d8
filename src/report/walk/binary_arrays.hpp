// Arrays of numbers as one compressed text, as a page in a browser can hold it.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

namespace enfilade {

/// Little-endian arrays, one after the other, each from a place that four divides. Numbers of
/// several bytes are kept as all their first bytes, then all their second bytes, and so on: light
/// and places that lie close together differ in the last bytes alone, so that this packs better.
class BinaryArrays {
 public:
  void add(const std::string& name, std::span<const float> values);
  void add(const std::string& name, std::span<const std::uint32_t> values);
  void add(const std::string& name, std::span<const std::uint16_t> values);
  void add(const std::string& name, std::span<const std::uint8_t> values);

  /// Returns [{"name", "bytes": of a number, "length": in numbers}, ...], in their order.
  nlohmann::ordered_json list() const;
  /// Returns the arrays compressed (zlib, RFC 1950), as base64 (RFC 4648).
  std::string text() const;
  std::size_t bytes() const { return data_.size(); }

 private:
  void add_bytes(const std::string& name, const void* values, std::size_t width,
                 std::size_t length);
  struct Entry {
    std::string name;
    std::size_t width = 1, length = 0;
  };
  std::vector<Entry> entries_;
  std::string data_;
};

/// Returns the value as an IEEE 754 number of 16 bits, the nearest: to 1 part in 2048 from 6.1e-5
/// to 65504, and to 3e-8 below.
std::uint16_t half_float(double value);

}  // namespace enfilade
