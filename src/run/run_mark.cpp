#include "run/run_mark.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/posix_file.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int run_version = 3;  // 3: G_cluster only where it is asked for
constexpr const char* name_another = "name another directory with -o";

std::string mark_path(const std::string& run_directory) { return run_directory + "/run.json"; }

/// An unfinished mark does not count.
bool is_empty(const std::string& directory) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, code)) {
    if (entry.path().filename() != "run.json.new") return false;
  }
  return true;
}

}  // namespace

std::optional<RunMark> read_run_mark(const std::string& run_directory) {
  std::ifstream in(mark_path(run_directory));
  const Json json = in ? Json::parse(in, nullptr, false) : Json();
  const auto format = json.is_object() ? json.find("format") : json.end();
  if (format == json.end() || *format != "enfilade-run") return std::nullopt;
  try {
    if (json.at("version") != run_version) return RunMark{};
    RunMark mark;
    mark.scene_hash = hash_from_text(json.at("scene_hash"));
    mark.options = json.at("options").dump();
    mark.has_visibility = json.at("has_visibility");
    mark.covered_area_m2 = json.at("covered_area_m2");
    mark.prepare_s = json.at("prepare_s");
    for (const Json& step : json.at("steps")) {
      mark.steps.push_back({step.at("name"), step.at("wall_s"), step.at("peak_rss_bytes")});
    }
    for (const Json& w : json.at("warnings")) mark.warnings.add(w.at(0), w.at(1));
    mark.prepared = json.at("prepared");
    return mark;
  } catch (const Json::exception&) {  // damaged, or of another version: to be prepared again
  } catch (const std::logic_error&) {
  }
  return RunMark{};
}

void write_run_mark(const std::string& run_directory, const RunMark& mark) {
  Json warnings = Json::array();
  for (const Warning& w : mark.warnings.all()) warnings.push_back({w.where, w.what});
  Json steps = Json::array();
  for (const PrepareStep& step : mark.steps) {
    steps.push_back(
        {{"name", step.name}, {"wall_s", step.wall_s}, {"peak_rss_bytes", step.peak_rss_bytes}});
  }
  const Json json = {{"format", "enfilade-run"},
                     {"version", run_version},
                     {"prepared", mark.prepared},
                     {"scene_hash", hash_text(mark.scene_hash)},
                     {"options", Json::parse(mark.options.empty() ? "{}" : mark.options)},
                     {"has_visibility", mark.has_visibility},
                     {"covered_area_m2", mark.covered_area_m2},
                     {"prepare_s", mark.prepare_s},
                     {"steps", steps},
                     {"warnings", warnings}};
  replace_file(mark_path(run_directory),
               json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void check_run_directory(const std::string& run_directory) {
  std::error_code code;
  fs::path there = fs::absolute(run_directory, code);
  if (fs::exists(there, code)) {
    if (!fs::is_directory(there, code)) {
      throw InputError(run_directory, "-o", "is a file, not a directory", name_another);
    }
    if (!read_run_mark(run_directory) && !is_empty(run_directory)) {
      throw InputError(run_directory, "-o", "holds files and is no RUN directory of enfilade",
                       "name an empty or a new directory with -o");
    }
  }
  while (!fs::exists(there, code) && there.has_relative_path()) there = there.parent_path();
  if (!fs::is_directory(there, code)) {
    throw InputError(run_directory, "-o", there.string() + " is not a directory", name_another);
  }
  if (::access(there.c_str(), R_OK | W_OK | X_OK) != 0) {
    throw InputError(run_directory, "-o",
                     there.string() + " cannot be written: " + std::strerror(errno),
                     "give write permission there, or " + std::string(name_another));
  }
}

void claim_run_directory(const std::string& run_directory) {
  check_run_directory(run_directory);
  std::error_code code;
  fs::create_directories(run_directory, code);
  if (code) {
    throw InputError(run_directory, "-o", "cannot be made: " + code.message(), name_another);
  }
  write_run_mark(run_directory, {});
}

}  // namespace enfilade
