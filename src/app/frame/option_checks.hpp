// Checks of option values. Unlike CLI11's own ranges, they refuse infinity and what is no number.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace enfilade {

/// Accepts a finite number above zero.
CLI::Validator positive_number();
/// Accepts a finite number, zero or above.
CLI::Validator number_from_zero();
/// Accepts a finite number with low < x < high.
CLI::Validator number_between(double low, double high);
/// Accepts a number with 0 <= x <= 1.
CLI::Validator share_of_one();
/// A whole number of at most 19 digits, the first no idle 0: a seed.
CLI::Validator whole_number();

/// Adds --switch NAME=FACTOR, which may stand several times, of a run that has shares.
void add_switch_option(CLI::App& sub, std::vector<std::string>& switches);

}  // namespace enfilade
