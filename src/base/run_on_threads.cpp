#include "base/run_on_threads.hpp"

#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace enfilade {

void run_on_threads(int threads, const std::function<void(bool first)>& work) {
  std::exception_ptr error;
  std::mutex guard;
  const auto guarded = [&](bool first) {
    try {
      work(first);
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!error) error = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    try {
      for (int t = 1; t < threads; ++t) others.emplace_back(guarded, false);
    } catch (const std::system_error&) {  // as many as there are
    }
    guarded(true);
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace enfilade
