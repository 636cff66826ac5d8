#include "import/intake/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

TextLines::TextLines(std::string file, std::string_view bytes)
    : file_(std::move(file)), bytes_(bytes) {
  if (bytes_.substr(0, 3) == "\xEF\xBB\xBF") bytes_.remove_prefix(3);
}

bool TextLines::next() {
  while (!bytes_.empty()) {
    line_.clear();
    number_ = lines_taken_ + 1;
    for (bool joins = true; joins && !bytes_.empty();) {
      const std::size_t end = std::min(bytes_.find_first_of("\r\n"), bytes_.size());
      std::string_view part = bytes_.substr(0, end);
      bytes_.remove_prefix(
          std::min(end + (bytes_.substr(end, 2) == "\r\n" ? 2 : 1), bytes_.size()));
      ++lines_taken_;
      while (!part.empty() && is_blank(part.back())) part.remove_suffix(1);
      const std::string_view whole = line_.empty() ? part : std::string_view(line_);
      const std::size_t first = whole.find_first_not_of(" \t\r");
      const bool comment = first != std::string_view::npos && whole[first] == '#';
      joins = !part.empty() && part.back() == '\\' && !comment;
      if (joins) part.remove_suffix(1);
      line_.append(part).append(joins ? " " : "");
    }
    words_.clear();
    for (std::size_t i = 0; i < line_.size();) {
      while (i < line_.size() && is_blank(line_[i])) ++i;
      if (i == line_.size() || line_[i] == '#') break;
      const std::size_t begin = i;
      while (i < line_.size() && !is_blank(line_[i])) ++i;
      words_.push_back(std::string_view(line_).substr(begin, i - begin));
    }
    if (!words_.empty()) return true;
  }
  return false;
}

std::string TextLines::rest_from(std::size_t word) const {
  if (words_.size() <= word) return {};
  const char* const end = words_.back().data() + words_.back().size();
  return {words_[word].data(), end};
}

std::string TextLines::file_name(std::string text) {
  if (text.size() > 1 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  std::ranges::replace(text, '\\', '/');
  return text;
}

double TextLines::real(std::size_t word) const {
  if (word >= words_.size())
    fail(in_quotes(std::string(words_[0])) + " has too few numbers", "complete the line");
  std::string_view text = words_[word];
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || stop != text.data() + text.size() || !std::isfinite(value)) {
    fail(in_quotes(std::string(words_[word].substr(0, 40))) + " is no finite number",
         "write a number there");
  }
  return value;
}

void TextLines::fail(const std::string& what, const std::string& hint) const {
  throw InputError(file_, where(), what, hint);
}

}  // namespace enfilade
