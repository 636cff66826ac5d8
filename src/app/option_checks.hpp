// Checks of option values that refuse what is no finite number, which CLI11's own ranges let
// through.
#pragma once

#include <CLI/CLI.hpp>

namespace enfilade {

/// A finite number above zero.
CLI::Validator positive_number();
/// A finite number with low < x < high.
CLI::Validator number_between(double low, double high);

}  // namespace enfilade
