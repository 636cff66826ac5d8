// Warnings are collected by the rooms and printed by `app` alone.
#pragma once

#include <string>
#include <vector>

namespace enfilade {

/// One warning: the place in the input, what is wrong there and what was done about it.
struct Warning {
  std::string where;
  std::string what;
};

/// Collects warnings; equal `what` texts at many places become one printed line with a count.
class Warnings {
 public:
  void add(std::string where, std::string what);
  bool empty() const { return all_.empty(); }
  const std::vector<Warning>& all() const { return all_; }
  /// Returns one line per kind of warning: "what (N places: first, second, third, ...)".
  std::vector<std::string> summary(std::size_t places = 3) const;

 private:
  std::vector<Warning> all_;
};

}  // namespace enfilade
