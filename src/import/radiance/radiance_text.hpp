// The words of a Radiance scene description, each with the line it stands on.
#pragma once

#include <string>

namespace enfilade {

/// A line of a file, for messages.
struct RadiancePlace {
  std::string file;
  int line = 0;

  /// Throws InputError "file: line N: what; hint".
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const;
};

/// Returns a number, finite; fails at `place` where `word` is none.
double radiance_number(const std::string& word, const RadiancePlace& place);
/// Returns a word of the file as messages show it: in quotes, not too long.
std::string radiance_quoted(const std::string& word);

class RadianceText {
 public:
  RadianceText(std::string file, std::string bytes)
      : bytes_(std::move(bytes)), place_{std::move(file), 1} {}

  /// Skips blanks and comments, which run from a # at the head of a word to the end of the line.
  bool at_end();
  /// True at a line that Radiance would give to the shell; ask at_end() first.
  bool at_command() const { return bytes_[at_] == '!'; }
  /// Returns the place of the next word.
  const RadiancePlace& place() const { return place_; }

  /// Returns a word up to the next blank, or all between two equal quotation marks. Fails at the
  /// end of the file, where `wanted` says what is missing.
  std::string word(const std::string& wanted);
  /// What follows the ! up to the end of the line; a backslash before it joins the next line.
  std::string command();

 private:
  char take();

  std::string bytes_;
  std::size_t at_ = 0;
  RadiancePlace place_;
};

}  // namespace enfilade
