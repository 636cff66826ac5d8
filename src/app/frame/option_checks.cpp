#include "app/frame/option_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>

namespace enfilade {

namespace {

/// A finite number that `holds` is true of.
CLI::Validator number_where(std::function<bool(double)> holds, std::string says, std::string type) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double x = 0.0;
        const bool good = CLI::detail::lexical_cast(text, x) && std::isfinite(x) && holds(x);
        return good ? "" : "'" + text + "' is not " + says;
      },
      type);
}

}  // namespace

CLI::Validator positive_number() {
  return number_where([](double x) { return x > 0.0; }, "a number above 0", "> 0");
}

CLI::Validator number_from_zero() {
  return number_where([](double x) { return x >= 0.0; }, "a number, 0 or more", ">= 0");
}

CLI::Validator number_between(double low, double high) {
  return number_where([=](double x) { return x > low && x < high; },
                      fmt::format("a number between {} and {}", low, high),
                      fmt::format("{} to {}", low, high));
}

CLI::Validator share_of_one() {
  return number_where([](double x) { return x >= 0.0 && x <= 1.0; }, "a number from 0 to 1",
                      "0 to 1");
}

CLI::Validator whole_number() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        const bool good = !text.empty() && text.size() < 20 && (text == "0" || text[0] != '0') &&
                          text.find_first_not_of("0123456789") == std::string::npos;
        return good ? "" : "'" + text + "' is not a whole number of at most 19 digits";
      },
      "0, 1, ...");
}

void add_switch_option(CLI::App& sub, std::vector<std::string>& switches) {
  sub.add_option("--switch", switches,
                 "NAME=FACTOR: dim a luminaire or a switch, as 'desk lamp=0.3', or turn it off, as "
                 "'desk lamp=0'; several times for several. The run must have shares: 'solve "
                 "--shares'")
      ->allow_extra_args(false);
}

}  // namespace enfilade
