#include "base/peak_memory.hpp"

#include <sys/resource.h>

namespace enfilade {

std::uint64_t peak_rss_bytes() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace enfilade
