// Values of a run record as the program prints them.
#pragma once

#include <string>

#include "base/run_record.hpp"

namespace enfilade {

/// Returns a number as the end of its key asks for: seconds, bytes, a share in percent, else 4
/// digits.
std::string shown_number(const std::string& key, double x);

/// Any value: counts with thousands, yes or no, text, and lists of numbers between commas.
std::string shown_value(const std::string& key, const RunRecord::Value& value);

}  // namespace enfilade
