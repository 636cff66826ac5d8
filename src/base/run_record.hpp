// RUN/stats.json: a flat record, one number, word or list of numbers a key.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace enfilade {

/// Keys keep the order in which they were first set. Numbers are doubles or integers; NaN becomes
/// null.
class RunRecord {
 public:
  using Value = std::variant<double, std::int64_t, bool, std::string, std::vector<double>>;

  void set(const std::string& key, Value value);
  void set(const std::string& key, const char* word) { set(key, Value(std::string(word))); }
  template <class Integer>
  requires(std::is_integral_v<Integer> &&
           !std::is_same_v<Integer, bool>) void set(const std::string& key, Integer n) {
    set(key, Value(static_cast<std::int64_t>(n)));
  }
  /// Returns the value under `key`; null where there is none.
  const Value* find(const std::string& key) const;
  /// Returns the number under `key`; `otherwise` where there is none.
  double number(const std::string& key, double otherwise) const;
  const std::vector<std::pair<std::string, Value>>& entries() const { return entries_; }

 private:
  std::vector<std::pair<std::string, Value>> entries_;
};

}  // namespace enfilade
