// The checksum that files of a run carry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace enfilade {

/// Returns XXH64 of the bytes, seed 0.
std::uint64_t checksum(std::span<const std::byte> bytes);
inline std::uint64_t checksum(std::string_view text) {
  return checksum(std::as_bytes(std::span(text)));
}

}  // namespace enfilade
