#include "run/stats_json.hpp"

#include <cmath>
#include <optional>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "json/json_text.hpp"
#include "run/sealed_reports.hpp"

namespace enfilade {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t most_ranks = 1u << 24;

Json finite(double d) { return std::isfinite(d) ? Json(d) : Json(nullptr); }

Json json_of(const RunRecord::Value& value) {
  if (const auto* d = std::get_if<double>(&value)) return finite(*d);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) {
    Json array = Json::array();
    for (double d : *list) array.push_back(finite(d));
    return array;
  }
  return std::visit([](const auto& v) { return Json(v); }, value);
}

[[noreturn]] void refuse_value(const std::string& path, const std::string& where,
                               const std::string& what) {
  throw InputError(path, where, what, "give a run directory that a solve has written");
}

double number_of(const Json& json, const std::string& path, const std::string& key) {
  if (json.is_null()) return std::nan("");
  if (!json.is_number()) refuse_value(path, key, "a list shall hold numbers only");
  return json.get<double>();
}

RunRecord::Value value_of(const Json& json, const std::string& path, const std::string& key) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number() || json.is_null()) return number_of(json, path, key);
  if (!json.is_array())
    refuse_value(path, key, "a value shall be a number, a word or a list of numbers");
  std::vector<double> list;
  for (const Json& item : json) list.push_back(number_of(item, path, key));
  return list;
}

RunRecord record_of(const Json& json, const std::string& path) {
  if (!json.is_object()) refuse_value(path, "top", "an object of keys and values is expected");
  RunRecord record;
  for (const auto& [key, value] : json.items()) record.set(key, value_of(value, path, key));
  return record;
}

Json parse_list(const std::string& text, const std::string& path) {
  Json json = parse_ordered_json(text, path);
  if (!json.is_array()) refuse_value(path, "top", "a list is expected");
  return json;
}

/// `from` of the file's text; an empty result where there is none.
template <class Result>
Result report(const std::string& run_directory, const char* name,
              Result (*from)(const std::string& text, const std::string& path)) {
  const std::optional<std::string> text = read_report(run_directory, name);
  return text ? from(*text, run_directory + "/" + name) : Result{};
}

}  // namespace

std::string to_json(const RunRecord& record) {
  Json json = Json::object();
  for (const auto& [key, value] : record.entries()) json[key] = json_of(value);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_stats(const RunRecord& record, const std::string& path) {
  write_file_atomically(path, to_json(record));
}

RunRecord record_from(const std::string& text, const std::string& path) {
  return record_of(parse_ordered_json(text, path), path);
}

std::vector<RunRecord> history_from(const std::string& text, const std::string& path) {
  std::vector<RunRecord> history;
  for (const Json& item : parse_list(text, path)) history.push_back(record_of(item, path));
  return history;
}

std::vector<Rank> owners_from(const std::string& text, const std::string& path) {
  std::vector<Rank> owners;
  for (const Json& item : parse_list(text, path)) {
    if (!item.is_number_unsigned() || item.get<std::uint64_t>() > most_ranks)
      refuse_value(path, std::to_string(owners.size()), "a rank is expected");
    owners.push_back(Rank{item.get<int>()});
  }
  return owners;
}

std::vector<std::string> lines_from(const std::string& text, const std::string& path) {
  std::vector<std::string> lines;
  for (const Json& item : parse_list(text, path)) {
    if (!item.is_string())
      refuse_value(path, std::to_string(lines.size()), "a line of text is expected");
    lines.push_back(item.get<std::string>());
  }
  return lines;
}

RunRecord read_stats(const std::string& run_directory) {
  return report(run_directory, "stats.json", record_from);
}
std::vector<RunRecord> read_history(const std::string& run_directory) {
  return report(run_directory, "history.json", history_from);
}
std::vector<Rank> read_owners(const std::string& run_directory) {
  return report(run_directory, "assignment.json", owners_from);
}
std::vector<std::string> read_warnings(const std::string& run_directory) {
  return report(run_directory, "warnings.json", lines_from);
}

}  // namespace enfilade
