#include "run/stats_json.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {

namespace {

using Json = nlohmann::ordered_json;

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

[[noreturn]] void refuse(const std::string& path, const std::string& where,
                         const std::string& what) {
  throw InputError(path, where, what, "give a run directory that a solve has written");
}

double number_of(const Json& json, const std::string& path, const std::string& key) {
  if (json.is_null()) return std::nan("");
  if (!json.is_number()) refuse(path, key, "a list shall hold numbers only");
  return json.get<double>();
}

RunRecord::Value value_of(const Json& json, const std::string& path, const std::string& key) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number() || json.is_null()) return number_of(json, path, key);
  if (!json.is_array()) refuse(path, key, "a value shall be a number, a word or a list of numbers");
  std::vector<double> list;
  for (const Json& item : json) list.push_back(number_of(item, path, key));
  return list;
}

RunRecord record_of(const Json& json, const std::string& path) {
  if (!json.is_object()) refuse(path, "top", "an object of keys and values is expected");
  RunRecord record;
  for (const auto& [key, value] : json.items()) record.set(key, value_of(value, path, key));
  return record;
}

Json parse(const std::string& path) {
  std::ifstream in(path);
  if (!in) refuse(path, "file", "it cannot be read");
  try {
    return Json::parse(in);
  } catch (const nlohmann::json::exception& e) {
    refuse(path, "JSON", e.what());
  }
}

/// The file's list, or an empty one where there is no file.
Json parse_list(const std::string& path) {
  if (!std::filesystem::exists(path)) return Json::array();
  Json json = parse(path);
  if (!json.is_array()) refuse(path, "top", "a list is expected");
  return json;
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

RunRecord read_stats(const std::string& path) { return record_of(parse(path), path); }

std::vector<RunRecord> read_history(const std::string& path) {
  std::vector<RunRecord> history;
  for (const Json& item : parse_list(path)) history.push_back(record_of(item, path));
  return history;
}

std::vector<Rank> read_owners(const std::string& path) {
  std::vector<Rank> owners;
  for (const Json& item : parse_list(path)) {
    if (!item.is_number_unsigned())
      refuse(path, std::to_string(owners.size()), "a rank is expected");
    owners.push_back(Rank{item.get<int>()});
  }
  return owners;
}

std::vector<std::string> read_lines(const std::string& path) {
  std::vector<std::string> lines;
  for (const Json& item : parse_list(path)) {
    if (!item.is_string()) refuse(path, std::to_string(lines.size()), "a line of text is expected");
    lines.push_back(item.get<std::string>());
  }
  return lines;
}

}  // namespace enfilade
