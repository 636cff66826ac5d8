#include "base/memory_wanted.hpp"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

namespace enfilade {
namespace {

thread_local const char* purpose_now = "";
thread_local RefusedMemory refused;

/// Given back at the first refusal: what unwinds then needs memory itself (so do destructors of
/// nlohmann::json, which must not fail). Nothing is written there, so that it costs addresses
/// alone; where there are few, it is at most half of them.
class Reserve {
 public:
  Reserve() {
    for (std::size_t bytes = most; bytes >= least && memory_ == nullptr; bytes /= 2) {
      void* twice = std::malloc(2 * bytes);
      std::free(twice);
      if (twice != nullptr) memory_ = std::malloc(bytes);
    }
  }
  ~Reserve() { give_back(); }
  Reserve(const Reserve&) = delete;
  Reserve& operator=(const Reserve&) = delete;
  void give_back() { std::free(memory_.exchange(nullptr)); }

 private:
  static constexpr std::size_t most = std::size_t{32} << 20, least = std::size_t{1} << 20;
  std::atomic<void*> memory_{nullptr};
};

Reserve reserve;

}  // namespace

MemoryPurpose::MemoryPurpose(const char* purpose) : before_(purpose_now) { purpose_now = purpose; }
MemoryPurpose::~MemoryPurpose() { purpose_now = before_; }

RefusedMemory refused_memory() { return refused; }
void take_over(const RefusedMemory& refusal) { refused = refusal; }
const char* memory_purpose() { return purpose_now; }

/// No machine has more for one request.
constexpr std::size_t most_bytes = std::size_t{1} << 40;

static void* allocate_or_null(std::size_t bytes) noexcept {
  return bytes > most_bytes ? nullptr : std::malloc(bytes == 0 ? 1 : bytes);
}

/// Behind operator new: std::bad_alloc itself does not tell how much was wanted.
static void* allocate(std::size_t bytes) {
  if (void* memory = allocate_or_null(bytes)) return memory;
  refused = {bytes, {}};
  if (purpose_now != nullptr)
    std::strncpy(refused.purpose.data(), purpose_now, refused.purpose.size() - 1);
  reserve.give_back();
  throw std::bad_alloc();
}

}  // namespace enfilade

void* operator new(std::size_t bytes) { return enfilade::allocate(bytes); }
void* operator new[](std::size_t bytes) { return enfilade::allocate(bytes); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return enfilade::allocate_or_null(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return enfilade::allocate_or_null(bytes);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
