#include "import/radiance/radiance_text.hpp"

#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

void RadiancePlace::fail(const std::string& what, const std::string& hint) const {
  throw InputError(file, "line " + std::to_string(line), what, hint);
}

double radiance_number(const std::string& word, const RadiancePlace& place) {
  // from_chars knows no plus sign, and heeds no locale.
  const std::size_t skip = word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0;
  double value = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stop, fault] = std::from_chars(word.data() + skip, end, value);
  if (fault != std::errc() || stop != end || !std::isfinite(value)) {
    place.fail(radiance_quoted(word) + " stands where a finite number is wanted",
               "write a number, and check the counts of arguments before it");
  }
  return value;
}

std::string radiance_quoted(const std::string& word) {
  constexpr std::size_t longest = 60;
  return in_quotes(word.size() <= longest ? word : word.substr(0, longest) + "...");
}

char RadianceText::take() {
  const char c = bytes_[at_++];
  if (c == '\n') ++place_.line;
  return c;
}

bool RadianceText::at_end() {
  for (bool comment = false; at_ < bytes_.size(); take()) {
    if (bytes_[at_] == '\n') comment = false;
    if (bytes_[at_] == '#') comment = true;
    if (!comment && !is_blank(bytes_[at_])) return false;
  }
  return true;
}

std::string RadianceText::word(const std::string& wanted) {
  if (at_end())
    place_.fail("the file ends before " + wanted, "complete the last primitive of the file");
  std::string text;
  if (bytes_[at_] == '"' || bytes_[at_] == '\'') {
    const RadiancePlace start = place_;
    const char quote = take();
    while (at_ < bytes_.size() && bytes_[at_] != quote) text += take();
    if (at_ == bytes_.size()) start.fail("a quotation is not closed", "write its other mark");
    take();
    return text;
  }
  while (at_ < bytes_.size() && !is_blank(bytes_[at_])) text += take();
  return text;
}

std::string RadianceText::command() {
  std::string text;
  take();
  while (at_ < bytes_.size() && bytes_[at_] != '\n') {
    const char c = take();
    const bool joins = c == '\\' && at_ < bytes_.size() && bytes_[at_] == '\n';
    text += joins ? ' ' : c;
    if (joins) take();
  }
  return text;
}

}  // namespace enfilade
