#include "scene_file/csv_records.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "json/json_text.hpp"

namespace enfilade {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

std::string trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t\r");
  if (from == std::string_view::npos) return {};
  return std::string(text.substr(from, text.find_last_not_of(" \t\r") - from + 1));
}

/// True where `separator` parts the line into the three fields that a place needs at least: not one
/// in a text, nor a tab behind each comma.
bool parts(std::string_view line, char separator) {
  bool quoted = false;
  char before = separator;
  int found = 0;
  for (const char c : line) {
    quoted ^= c == '"';
    if (c == separator && !quoted) {
      if (before == ',') return false;
      ++found;
    }
    if (c != ' ') before = c;
  }
  return found >= 2;
}

/// What separates the fields of the first line that is neither blank nor a comment.
char separator_of(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (!line.starts_with('#') && !trimmed(line).empty()) {
      for (const char separator : {';', '\t'}) {
        if (parts(line, separator)) return separator;
      }
      return ',';
    }
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return ',';
}

/// Reads one record after the other.
class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& path) : text_(text), path_(path) {
    if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
    separator_ = separator_of(text_);
    take_told_separator();
    ends_ = {separator_, '\n'};
    blanks_ = separator_ == '\t' ? " " : " \t";
  }

  char separator() const { return separator_; }

  bool at_end() const { return at_ >= text_.size(); }

  CsvRecord next() {
    CsvRecord record;
    record.line = line_;
    const std::size_t begin = at_;
    bool more = true;
    while (more) {
      record.fields.push_back(next_field(record));
      more = at_ < text_.size() && text_[at_] == separator_;
      if (more) ++at_;
    }
    record.text = text_.substr(begin, at_ - begin);
    if (record.text.ends_with('\r')) record.text.remove_suffix(1);
    if (at_ < text_.size()) ++at_;  // the line's end
    ++line_;
    return record;
  }

 private:
  /// A first line such as "sep=;", by which spreadsheets say what separates the fields.
  void take_told_separator() {
    constexpr std::string_view head = "sep=";
    std::string_view line = text_.substr(0, text_.find('\n'));
    const std::size_t next = std::min(line.size() + 1, text_.size());
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.size() != head.size() + 1 || !line.starts_with(head)) return;
    if (std::string_view(",;\t|").find(line.back()) == std::string_view::npos) return;
    separator_ = line.back();
    at_ = next;
    ++line_;
  }

  /// Ends at a separator, a line's end or the file's.
  std::string next_field(const CsvRecord& record) {
    const std::size_t begin = text_.find_first_not_of(blanks_, at_);
    if (begin != std::string_view::npos && text_[begin] == '"') return quoted(begin + 1, record);
    const std::size_t end = std::min(text_.find_first_of(ends_, at_), text_.size());
    const std::string_view field = text_.substr(at_, end - at_);
    at_ = end;
    return trimmed(field);
  }

  std::string quoted(std::size_t from, const CsvRecord& record) {
    std::string field;
    for (at_ = from; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] != '"') {
        field += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        field += text_[at_++];
      } else {
        at_ = std::min(text_.find_first_of(ends_, at_), text_.size());
        return field;
      }
    }
    throw InputError(path_, csv_place(record, record.fields.size()),
                     "has a quote that is not closed", "write \" at the end of the field");
  }

  std::string_view text_;
  const std::string& path_;
  char separator_ = ',';
  std::string ends_, blanks_;  ///< of a field; before a quote
  std::size_t at_ = 0, line_ = 1;
};

}  // namespace

CsvTable csv_table(std::string_view text, const std::string& path) {
  CsvReader reader(text, path);
  CsvTable table{reader.separator(), {}};
  while (!reader.at_end()) {
    CsvRecord record = reader.next();
    const bool blank = record.fields.size() == 1 && record.fields[0].empty();
    if (!blank && !record.text.starts_with('#')) table.records.push_back(std::move(record));
  }
  return table;
}

std::string csv_place(const CsvRecord& record, std::size_t column, const std::string& name) {
  std::string place =
      "line " + std::to_string(record.line) + ", column " + std::to_string(column + 1);
  if (!name.empty()) place += " " + in_quotes(name);
  return place;
}

}  // namespace enfilade
