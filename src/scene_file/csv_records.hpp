// Records of a CSV file (RFC 4180), with the places that errors name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace enfilade {

struct CsvRecord {
  std::size_t line = 1;             ///< of the file, where the record begins
  std::string_view text;            ///< as it stands there, without its line end
  std::vector<std::string> fields;  ///< without quotes, and without blanks around them
};

/// Returns the records of `text`, which must outlive them; blank lines and lines that begin with #
/// are left out. Quoted fields may hold commas, line breaks, and quotes written twice. Throws
/// InputError where a quote is not closed.
std::vector<CsvRecord> csv_records(std::string_view text, const std::string& path);

/// Returns how errors name a field: `line 3, column 2 "y"`; `name` may be empty.
std::string csv_place(const CsvRecord& record, std::size_t column, const std::string& name = {});

}  // namespace enfilade
