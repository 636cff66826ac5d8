#include "base/memory_wanted.hpp"

#include <cstdlib>
#include <new>

namespace enfilade {
namespace {

thread_local const char* purpose_now = "";
thread_local RefusedMemory refused;

}  // namespace

MemoryPurpose::MemoryPurpose(const char* purpose) : before_(purpose_now) { purpose_now = purpose; }
MemoryPurpose::~MemoryPurpose() { purpose_now = before_; }

RefusedMemory refused_memory() { return refused; }

/// Behind operator new: std::bad_alloc itself does not tell how much was wanted.
static void* allocate(std::size_t bytes) {
  if (void* memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
  refused = {bytes, purpose_now};
  throw std::bad_alloc();
}

}  // namespace enfilade

void* operator new(std::size_t bytes) { return enfilade::allocate(bytes); }
void* operator new[](std::size_t bytes) { return enfilade::allocate(bytes); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
