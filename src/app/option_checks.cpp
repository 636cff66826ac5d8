#include "app/option_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace enfilade {

namespace {

CLI::Validator open_range(double low, double high, std::string says, std::string type) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double x = 0.0;
        const bool good =
            CLI::detail::lexical_cast(text, x) && std::isfinite(x) && x > low && x < high;
        return good ? "" : "'" + text + "' is not " + says;
      },
      type);
}

}  // namespace

CLI::Validator positive_number() {
  return open_range(0.0, std::numeric_limits<double>::infinity(), "a number above 0", "> 0");
}

CLI::Validator number_between(double low, double high) {
  return open_range(low, high, fmt::format("a number between {} and {}", low, high),
                    fmt::format("{} to {}", low, high));
}

}  // namespace enfilade
