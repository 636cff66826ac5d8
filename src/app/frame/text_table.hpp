// Small tables of labels and values on standard output.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace enfilade {

/// Rows of a label and a value; the values stand in one column.
class TextTable {
 public:
  explicit TextTable(std::string title = "") : title_(std::move(title)) {}
  void add(std::string label, std::string value) {
    rows_.emplace_back(std::move(label), std::move(value));
  }
  std::string text() const;

 private:
  std::string title_;
  std::vector<std::pair<std::string, std::string>> rows_;
};

/// 1234567 -> "1,234,567".
std::string with_thousands(std::uint64_t n);
/// 0.42 -> "0.42 s", 75 -> "1 min 15 s", 4000 -> "1 h 07 min".
std::string format_duration(double seconds);
/// 1536 -> "1.5 KiB".
std::string format_bytes(double bytes);

}  // namespace enfilade
