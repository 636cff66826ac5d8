#include "scene_file/probe_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "base/limits.hpp"
#include "base/safe_text.hpp"
#include "json/json_text.hpp"
#include "scene_file/csv_records.hpp"

namespace enfilade {
namespace {

constexpr std::array<const char*, 6> coordinate_names{"x", "y", "z", "nx", "ny", "nz"};

/// Returns none for what is no number, and for what is none that is finite. The decimal sign is a
/// point, or a comma where none separates the fields.
std::optional<double> number_in(std::string field, char separator) {
  if (separator != ',' && field.find(',') != std::string::npos) field[field.find(',')] = '.';
  const char* begin = field.data() + (field.starts_with('+') ? 1 : 0);
  const char* end = field.data() + field.size();
  double x = 0.0;
  const auto [rest, fault] = std::from_chars(begin, end, x);
  if (fault != std::errc() || rest != end || begin == end || !std::isfinite(x)) return std::nullopt;
  return x;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Where the six coordinates stand among the columns; the last three may be missing.
struct Layout {
  std::array<std::size_t, 6> column{};
  bool has_normals = false;
};

class TableReader {
 public:
  explicit TableReader(ProbeFile file) : file_(std::move(file)) {}

  ProbeFile read() {
    const CsvTable table = csv_table(file_.text, file_.path);
    const std::vector<CsvRecord>& records = table.records;
    file_.table.separator = table.separator;
    if (records.empty())
      throw InputError(file_.path, "line 1", "there are no points", "write x,y,z on a line each");
    const bool has_header = !is_number(records[0].fields[0]);
    has_header ? read_header(records[0]) : make_header(records[0]);
    for (std::size_t i = has_header ? 1 : 0; i < records.size(); ++i) read_row(records[i]);
    if (file_.probes.empty()) {
      throw InputError(file_.path, "line " + std::to_string(records[0].line + 1),
                       "there are no points below the header", "write x,y,z on a line each");
    }
    return std::move(file_);
  }

 private:
  void read_header(const CsvRecord& record) {
    file_.table.columns = record.fields;
    file_.table.header = record.text;
    std::size_t normals = 0;
    for (std::size_t i = 0; i < coordinate_names.size(); ++i) {
      const auto it = std::ranges::find_if(record.fields, [&](const std::string& name) {
        return lower(name) == coordinate_names[i];
      });
      const bool found = it != record.fields.end();
      normals += i >= 3 && found;
      layout_.column[i] = static_cast<std::size_t>(it - record.fields.begin());
      if (!found && i < 3) {
        throw InputError(
            file_.path, "line " + std::to_string(record.line),
            std::string("the header has no column ") + in_quotes(coordinate_names[i]),
            "name the columns x,y,z or x,y,z,nx,ny,nz, separated by commas, semicolons or tabs");
      }
    }
    if (normals == 1 || normals == 2) {
      throw InputError(file_.path, "line " + std::to_string(record.line),
                       "the header has not all of nx, ny and nz", "name all three, or none");
    }
    layout_.has_normals = normals == 3;
  }

  void make_header(const CsvRecord& record) {
    const std::size_t count = record.fields.size();
    layout_.has_normals = count >= 6 && is_number(record.fields[3]) &&
                          is_number(record.fields[4]) && is_number(record.fields[5]);
    for (std::size_t i = 0; i < std::max<std::size_t>(count, 3); ++i) {
      const bool named = i < (layout_.has_normals ? 6u : 3u);
      file_.table.columns.push_back(named ? coordinate_names[i] : fmt::format("column_{}", i + 1));
    }
    for (std::size_t i = 0; i < 6; ++i) layout_.column[i] = i;
    for (const std::string& name : file_.table.columns)
      file_.table.header +=
          (file_.table.header.empty() ? "" : std::string(1, file_.table.separator)) + name;
  }

  void read_row(const CsvRecord& record) {
    const std::size_t count = file_.table.columns.size();
    if (record.fields.size() != count) {
      throw InputError(
          file_.path, "line " + std::to_string(record.line),
          fmt::format("has {} fields, where {} are named", record.fields.size(), count),
          fmt::format(
              "write as many on each line, separated by {}, as on the first one",
              file_.table.separator == '\t' ? "tabs" : in_quotes({&file_.table.separator, 1})));
    }
    Probe probe;
    for (std::size_t i = 0; i < 3; ++i) probe.p[static_cast<int>(i)] = number(record, i);
    check(record, 0, limits::fault_of_place(probe.p));
    if (layout_.has_normals) {
      for (std::size_t i = 0; i < 3; ++i) probe.n[static_cast<int>(i)] = number(record, 3 + i);
      check(record, 3, limits::fault_of_direction(probe.n));
      probe.n = limits::unit(probe.n);
    }
    file_.probes.push_back(probe);
    file_.table.lines.emplace_back(record.text);
    file_.table.rows.push_back(record.fields);
  }

  bool is_number(const std::string& field) const {
    return number_in(field, file_.table.separator).has_value();
  }

  std::string place(const CsvRecord& record, std::size_t coordinate) const {
    const std::size_t column = layout_.column[coordinate];
    return csv_place(record, column, file_.table.columns[column]);
  }

  double number(const CsvRecord& record, std::size_t coordinate) {
    const std::string& field = record.fields[layout_.column[coordinate]];
    const bool comma = field.find(',') != std::string::npos;
    file_.table.decimal_comma |= comma;
    decimal_point_ |= field.find('.') != std::string::npos;
    if (decimal_point_ && file_.table.decimal_comma) {
      throw InputError(file_.path, place(record, coordinate),
                       "is " + in_quotes(field) + ", where numbers before have a decimal " +
                           (comma ? "point" : "comma"),
                       "write all numbers with the same decimal sign, none for thousands");
    }
    if (const auto x = number_in(field, file_.table.separator)) return *x;
    throw InputError(file_.path, place(record, coordinate),
                     "is " + in_quotes(field) + ", not a finite number",
                     coordinate < 3 ? "write metres, as in 1.25" : "write a number, as in 0 or -1");
  }

  void check(const CsvRecord& record, std::size_t coordinate, const limits::Fault& fault) const {
    if (fault) throw InputError(file_.path, place(record, coordinate), fault.what, fault.hint);
  }

  bool decimal_point_ = false;  ///< a number had one
  ProbeFile file_;
  Layout layout_;
};

/// Writes fields as the table has its own.
class FieldWriter {
 public:
  explicit FieldWriter(const ProbeTable& table) : table_(table) {}

  /// A field behind others.
  std::string text(const std::string& words) const {
    std::string field = csv_field(words);
    if (!field.starts_with('"') && field.find(table_.separator) != std::string::npos)
      field = '"' + field + '"';
    return table_.separator + field;
  }
  std::string number(double value) const {
    std::string field = fmt::format("{:.9g}", value);
    if (table_.decimal_comma) std::ranges::replace(field, '.', ',');
    return table_.separator + field;
  }
  std::string numbers(const Spectrum& values) const {
    std::string fields;
    for (const double value : values) fields += number(value);
    return fields;
  }
  /// "E" of one band; "E_0", "E_1", ... of several.
  std::string bands(const std::string& name, std::size_t count) const {
    if (count == 1) return text(name);
    std::string fields;
    for (std::size_t b = 0; b < count; ++b) fields += text(fmt::format("{}_{}", name, b));
    return fields;
  }

 private:
  const ProbeTable& table_;
};

/// The columns of a JSON source, of which only names are kept beside the coordinates.
ProbeTable table_of_json(const ProbeFile& source) {
  ProbeTable table;
  table.header = "x,y,z,nx,ny,nz";
  const nlohmann::json document = parse_json(source.text, source.path);
  const nlohmann::json& probes = document["probes"];
  const bool named = std::ranges::any_of(probes, [](const nlohmann::json& probe) {
    return probe.contains("name") && probe["name"].is_string();
  });
  if (named) table.header += ",name";
  for (std::size_t i = 0; i < source.probes.size(); ++i) {
    const Probe& probe = source.probes[i];
    std::string line = fmt::format("{},{},{},{},{},{}", probe.p.x, probe.p.y, probe.p.z, probe.n.x,
                                   probe.n.y, probe.n.z);
    if (named) {
      const nlohmann::json name = probes[i].value("name", nlohmann::json());
      line += "," + csv_field(name.is_string() ? name.get<std::string>() : "");
    }
    table.lines.push_back(std::move(line));
  }
  return table;
}

}  // namespace

bool is_table(const std::string& path) { return lower(path).ends_with(".csv"); }

ProbeFile read_probe_table(ProbeFile file) { return TableReader(std::move(file)).read(); }

std::string probe_table(const ProbeFile& source, const std::vector<ProbeAnswer>& answers,
                        const std::string& from, const std::string& unit) {
  const ProbeTable made = source.table.columns.empty() ? table_of_json(source) : ProbeTable();
  const ProbeTable& table = source.table.columns.empty() ? made : source.table;
  const FieldWriter fields(table);
  const std::size_t bands = answers[0].irradiance.size();
  std::string csv = table.header + fields.bands("E", bands) + fields.bands("error", bands);
  if (!answers[0].daylight_factor.empty()) csv += fields.bands("daylight_factor", bands);
  csv += fields.text("unit") + fields.text("from");
  for (const auto& [name, light] : answers[0].shares) csv += fields.bands("E by " + name, bands);
  csv += "\n";
  for (std::size_t i = 0; i < answers.size(); ++i) {
    csv += table.lines[i] + fields.numbers(answers[i].irradiance) +
           fields.numbers(answers[i].error) + fields.numbers(answers[i].daylight_factor) +
           fields.text(unit) + fields.text(from);
    for (const auto& [name, light] : answers[i].shares) csv += fields.numbers(light);
    csv += "\n";
  }
  return csv;
}

nlohmann::ordered_json json_of_table(const ProbeFile& source) {
  nlohmann::ordered_json probes = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < source.probes.size(); ++i) {
    const Probe& probe = source.probes[i];
    nlohmann::ordered_json entry{{"p", {probe.p.x, probe.p.y, probe.p.z}},
                                 {"n", {probe.n.x, probe.n.y, probe.n.z}}};
    for (std::size_t k = 0; k < source.table.columns.size(); ++k) {
      const std::string& name = source.table.columns[k];
      const bool coordinate =
          std::ranges::find(coordinate_names, lower(name)) != coordinate_names.end();
      if (coordinate || name.empty() || entry.contains(name)) continue;
      const std::string& field = source.table.rows[i][k];
      if (const auto x = number_in(field, source.table.separator)) {
        entry[name] = *x;
      } else {
        entry[name] = field;
      }
    }
    probes.push_back(std::move(entry));
  }
  return {{"probes", std::move(probes)}};
}

}  // namespace enfilade
