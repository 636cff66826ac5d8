#include "run/run_mark.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/byte_stream.hpp"
#include "base/checksum.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/posix_file.hpp"
#include "json/sealed_json.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr SealedFormat mark_format{"enfilade-run", mark_version, "run 'enfilade prepare' again"};
constexpr const char* name_another = "name another directory with -o";

std::string mark_path(const std::string& run_directory) { return run_directory + "/run.json"; }

/// An unfinished mark does not count.
bool is_empty(const std::string& directory) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, code)) {
    const std::string name = entry.path().filename().string();
    if (name != "lock" && !is_unfinished_file(name)) return false;
  }
  return true;
}

void take_mark(const Json& json, RunMark& mark) {
  mark.scene_hash = hash_from_text(json.at("scene_hash"));
  mark.options = json.at("options").dump();
  mark.has_visibility = json.at("has_visibility");
  mark.covered_area_m2 = json.at("covered_area_m2");
  mark.prepare_s = json.at("prepare_s");
  for (const auto& [name, sum] : json.at("files").items()) mark.files[name] = hash_from_text(sum);
  for (const Json& step : json.at("steps")) {
    mark.steps.push_back(
        {step.at("name"), step.at("wall_s"), whole<std::uint64_t>(step.at("peak_rss_bytes"))});
  }
  for (const Json& w : json.at("warnings")) mark.warnings.add(w.at(0), w.at(1));
  mark.prepared = json.at("prepared");
}

}  // namespace

std::uint64_t RunMark::preparation() const {
  ByteWriter w;
  w.put(scene_hash);
  for (const char* name : {"scene.json", "cells.bin", "clusters.bin"}) {
    const auto file = files.find(name);
    w.put(file == files.end() ? std::uint64_t{0} : file->second);
  }
  return checksum(w.bytes());
}

std::optional<RunMark> read_run_mark(const std::string& run_directory) {
  const std::string path = mark_path(run_directory);
  if (std::error_code code; !fs::is_regular_file(path, code)) return std::nullopt;
  const std::vector<std::byte> bytes = read_file(path);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.find(mark_format.format) == std::string::npos) return std::nullopt;  // not ours
  RunMark mark;
  try {
    unseal(mark_format, text, path, [&mark](const Json& json) { take_mark(json, mark); });
  } catch (const RunError& error) {
    mark = {};
    mark.fault = error.what();
  }
  return mark;
}

void write_run_mark(const std::string& run_directory, const RunMark& mark) {
  Json warnings = Json::array();
  for (const Warning& w : mark.warnings.all()) warnings.push_back({w.where, w.what});
  Json steps = Json::array();
  for (const PrepareStep& step : mark.steps) {
    steps.push_back(
        {{"name", step.name}, {"wall_s", step.wall_s}, {"peak_rss_bytes", step.peak_rss_bytes}});
  }
  Json files = Json::object();
  for (const auto& [name, sum] : mark.files) files[name] = hash_text(sum);
  replace_file(
      mark_path(run_directory),
      seal(mark_format, {{"prepared", mark.prepared},
                         {"scene_hash", hash_text(mark.scene_hash)},
                         {"options", Json::parse(mark.options.empty() ? "{}" : mark.options)},
                         {"has_visibility", mark.has_visibility},
                         {"covered_area_m2", mark.covered_area_m2},
                         {"prepare_s", mark.prepare_s},
                         {"files", files},
                         {"steps", steps},
                         {"warnings", warnings}}));
}

void keep_prepared_file(const std::string& run_directory, const std::string& name,
                        std::string_view bytes, RunMark& mark) {
  mark.files[name] = checksum(bytes);
  replace_file(run_directory + "/" + name, bytes);
}

std::string read_prepared_file(const std::string& run_directory, const std::string& name,
                               const RunMark& mark) {
  const std::string path = run_directory + "/" + name;
  const std::vector<std::byte> bytes = read_file(path);
  const auto known = mark.files.find(name);
  if (known == mark.files.end() || known->second != checksum(bytes)) {
    throw RunError(path + ": is damaged, or of another run (checksum); prepare the run again");
  }
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
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

void claim_run_directory(const std::string& run_directory, RunLock& lock) {
  check_run_directory(run_directory);
  std::error_code code;
  fs::create_directories(run_directory, code);
  if (code == std::errc::no_space_on_device || code == std::errc::io_error) {
    throw RunError(run_directory + ": cannot be made: " + code.message() + "; see to the disk");
  }
  if (code) {
    throw InputError(run_directory, "-o", "cannot be made: " + code.message(), name_another);
  }
  lock.write(run_directory);
  write_run_mark(run_directory, {});
}

}  // namespace enfilade
