// The lines of a text file as words, each line with its number.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace enfilade {

/// Goes through the lines of OBJ and MTL files. A byte order mark, blanks around a line, comments
/// (# at the head of a word) and empty lines are passed over; a backslash at the end of a line
/// joins the next one.
class TextLines {
 public:
  TextLines(std::string file, std::string_view bytes);

  /// Moves on to the next line; false at the end.
  bool next();
  const std::string& file() const { return file_; }
  int number() const { return number_; }
  std::string where() const { return "line " + std::to_string(number_); }
  const std::vector<std::string_view>& words() const { return words_; }
  /// Returns all behind the first word, such as a name with blanks in it.
  std::string rest() const { return rest_from(1); }
  /// Returns all from the word of this number on.
  std::string rest_from(std::size_t word) const;
  /// Returns all from the word of this number on as the name of a file: without quotes around it,
  /// and with slashes for backslashes.
  std::string file_name_from(std::size_t word) const { return file_name(rest_from(word)); }
  static std::string file_name(std::string text);

  /// Returns the word of this number as a finite number. Throws InputError that names the line.
  double real(std::size_t word) const;
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const;

 private:
  std::string file_;
  std::string_view bytes_;
  std::string line_;
  std::vector<std::string_view> words_;
  int number_ = 0, lines_taken_ = 0;
};

}  // namespace enfilade
