// The same work on several threads.
#pragma once

#include <functional>

namespace enfilade {

/// Calls `work(true)` on this thread and `work(false)` on up to `threads` - 1 others, and returns
/// when all are done. Throws the first error that one of them threw; the others are then done as
/// well. `work` divides itself, as by an atomic counter. Where the system gives fewer threads,
/// fewer do the work.
void run_on_threads(int threads, const std::function<void(bool first)>& work);

}  // namespace enfilade
