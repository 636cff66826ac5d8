// Memory of this process.
#pragma once

#include <cstdint>

namespace enfilade {

/// Returns the largest resident set of this process so far, bytes.
std::uint64_t peak_rss_bytes();

}  // namespace enfilade
