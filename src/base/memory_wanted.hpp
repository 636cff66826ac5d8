// What memory was wanted for when it ran out.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace enfilade {

/// Names what this thread wants memory for, as long as the object lives: "the scene x.json". The
/// text must outlive it.
class MemoryPurpose {
 public:
  explicit MemoryPurpose(const char* purpose);
  ~MemoryPurpose();
  MemoryPurpose(const MemoryPurpose&) = delete;
  MemoryPurpose& operator=(const MemoryPurpose&) = delete;

 private:
  const char* before_;
};

/// The request that this thread was refused last (std::bad_alloc).
struct RefusedMemory {
  std::size_t bytes = 0;            ///< 0: not known
  std::array<char, 256> purpose{};  ///< ends with 0; its own text is gone by the time it is told
};
RefusedMemory refused_memory();
/// Takes over the refusal of another thread, whose error is thrown on in this one.
void take_over(const RefusedMemory& refusal);
/// What this thread wants memory for now: of its innermost MemoryPurpose; empty for none.
const char* memory_purpose();

}  // namespace enfilade
