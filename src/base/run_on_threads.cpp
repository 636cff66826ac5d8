#include "base/run_on_threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

#include "base/memory_wanted.hpp"
#include "base/usable_cores.hpp"

namespace enfilade {

void run_on_threads(int threads, const std::function<void(bool first)>& work) {
  std::exception_ptr error;
  RefusedMemory refusal;  // of the thread that threw
  std::mutex guard;
  const auto guarded = [&, purpose = memory_purpose()](bool first) {
    const MemoryPurpose as_of_the_caller(purpose);
    try {
      work(first);
    } catch (...) {
      const std::lock_guard lock(guard);
      if (error) return;
      error = std::current_exception();
      refusal = refused_memory();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (int t = 1; t < threads; ++t) others.emplace_back(guarded, false);
    } catch (const std::system_error&) {  // as many as there are
    } catch (const std::bad_alloc&) {     // a thread needs memory too
    }
    guarded(true);
  }
  if (!error) return;
  take_over(refusal);
  std::rethrow_exception(error);
}

void for_each_on_threads(std::size_t count, std::string_view phase, const Progress& progress,
                         const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  const auto cores = static_cast<std::size_t>(usable_cores());
  run_on_threads(static_cast<int>(std::min(cores, count)), [&](bool reports) {
    for (std::size_t i = next++; i < count; i = next++) {
      work(i);
      if (reports)
        report_progress(progress, phase, static_cast<double>(i + 1) / static_cast<double>(count));
    }
  });
}

}  // namespace enfilade
