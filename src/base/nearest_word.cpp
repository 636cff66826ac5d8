#include "base/nearest_word.hpp"

#include <algorithm>
#include <vector>

namespace enfilade {
namespace {

/// Fewest single-letter edits between two words.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_word(const std::string& word, std::span<const std::string> known) {
  std::string nearest;
  std::size_t least = 3;
  for (const std::string& name : known) {
    if (word.size() >= 3 && name.starts_with(word)) return name;
    if (const std::size_t d = edit_distance(word, name); d < least) {
      least = d;
      nearest = name;
    }
  }
  return nearest;
}

}  // namespace enfilade
