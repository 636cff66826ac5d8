// The same work on several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "base/progress.hpp"

namespace enfilade {

/// Calls `work(true)` on this thread and `work(false)` on up to `threads` - 1 others, and returns
/// when all are done. Throws the first error that one of them threw; the others are then done as
/// well, and where memory was refused there, refused_memory() of this thread tells of it. `work`
/// divides itself, as by an atomic counter. Where the system gives fewer threads, fewer do the
/// work. All want memory for what this thread wants it for (memory_wanted.hpp).
void run_on_threads(int threads, const std::function<void(bool first)>& work);

/// Calls `work(i)` for each i < count, on all cores that there are (usable_cores.hpp), in no
/// certain order; reports the share that is done as progress of `phase`.
void for_each_on_threads(std::size_t count, std::string_view phase, const Progress& progress,
                         const std::function<void(std::size_t)>& work);

}  // namespace enfilade
