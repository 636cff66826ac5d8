// Leaks of a building as warnings to the user.
#pragma once

#include <vector>

#include "base/warnings.hpp"
#include "cells/rooms/leaks.hpp"

namespace enfilade {

/// Adds one warning per leak: which cell, where, how wide.
void warn_of_leaks(const std::vector<Leak>& leaks, Warnings& warnings);

}  // namespace enfilade
