// Memory of this process.
#pragma once

#include <cstdint>

namespace enfilade {

/// Bytes of memory that this process has used at most.
std::uint64_t peak_rss_bytes();

}  // namespace enfilade
