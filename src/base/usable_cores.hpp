// How many cores this process may use.
#pragma once

namespace enfilade {

/// Returns the number of cores that the process may run on, by its affinity (taskset) and by the
/// quota of its control group; at least 1.
int usable_cores();

}  // namespace enfilade
