// The choices that a run made by itself, each with its reason.
#pragma once

#include "base/run_record.hpp"

namespace enfilade {

/// Adds `chosen_bands`, `chosen_basis`, `chosen_cells`, `chosen_memory`, `chosen_patches` and
/// `chosen_visibility`, in words, to a record that has the figures of the run. `basis_is_asked`: by
/// --basis.
void describe_choices(RunRecord& record, bool basis_is_asked);

}  // namespace enfilade
