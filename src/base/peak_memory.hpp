// Memory of this process.
#pragma once

#include <cstdint>

namespace enfilade {

/// Returns the largest resident set of this process so far, bytes.
std::uint64_t peak_rss_bytes();

/// Gives memory that was freed back to the system, where the C library can (glibc). For the end of
/// a step that took much more than the next one will.
void release_freed_memory();

}  // namespace enfilade
