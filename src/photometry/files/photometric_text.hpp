// The text of a photometric file, whatever its encoding, as lines and as numbers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/warnings.hpp"

namespace enfilade {

/// Reports of one file: what is refused, and what is read with a warning.
class PhotometricReport {
 public:
  PhotometricReport(std::string file, Warnings& warnings)
      : file_(std::move(file)), warnings_(warnings) {}
  [[noreturn]] void fail(const std::string& where, const std::string& what,
                         const std::string& hint) const {
    throw InputError(file_, where, what, hint);
  }
  [[noreturn]] void fail(std::size_t line, const std::string& what, const std::string& hint) const {
    fail("line " + std::to_string(line), what, hint);
  }
  void warn(const std::string& what) { warnings_.add(file_, what); }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  Warnings& warnings_;
};

/// Returns the bytes as UTF-8: UTF-16 with or without its mark, UTF-8 with or without, else taken
/// as Latin-1. Ends at a control-Z, the old end of a file.
std::string photometric_text(const std::string& bytes, PhotometricReport& report);
/// Returns the lines, without spaces at their ends; CR, LF and CRLF end a line.
std::vector<std::string> lines_of(const std::string& text);

/// Returns the number that the whole word is; false for another word, also for "nan" and "inf".
bool number_of(std::string_view word, double& value);

/// A number and the line that it stands in, counted from 1.
struct PlacedNumber {
  double value = 0.0;
  std::size_t line = 0;
};

/// The numbers from one line on, up to the first word that is none.
struct NumberList {
  std::vector<PlacedNumber> numbers;
  std::size_t odd_line = 0;  ///< of the first word that is no number; 0 where there is none
  std::string odd_word;
};
/// How a comma is read: between numbers, or as the decimal sign.
enum class Comma { separates, decimal };
NumberList numbers_from(const std::vector<std::string>& lines, std::size_t first, Comma comma);

}  // namespace enfilade
