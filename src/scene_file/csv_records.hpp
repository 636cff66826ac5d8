// Records of a table of fields (CSV, RFC 4180), with the places that errors name.
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

struct CsvTable {
  char separator = ',';
  std::vector<CsvRecord> records;
};

/// Returns the records of `text`, which must outlive them; blank lines and lines that begin with #
/// are left out. Quoted fields may hold separators, line breaks, and quotes written twice. Fields
/// are separated by what stands in the first record: by semicolons or tabs, as spreadsheets write
/// where the comma is the decimal sign, else by commas; or by what a first line `sep=;` tells.
/// Throws InputError where a quote is not closed.
CsvTable csv_table(std::string_view text, const std::string& path);

/// Returns how errors name a field: `line 3, column 2 "y"`; `name` may be empty.
std::string csv_place(const CsvRecord& record, std::size_t column, const std::string& name = {});

}  // namespace enfilade
