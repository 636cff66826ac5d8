#include "app/frame/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

/// True for a file in RUN, or in one of its own folders, that something is computed from: one in
/// the place of it would end the run.
bool is_kept_by_run(const std::string& path) {
  std::error_code code;
  const fs::path whole = fs::absolute(path, code).lexically_normal();
  for (fs::path run = whole.parent_path(); run != run.root_path(); run = run.parent_path()) {
    if (!fs::exists(run / "run.json", code)) continue;
    const fs::path inside = whole.lexically_relative(run);
    const std::string first = inside.begin()->string();
    for (const char* own :
         {"run.json", "scene.json", "leaks.json", "reports.json", "stats.json", "history.json",
          "warnings.json", "assignment.json", "cells.bin", "clusters.bin", "graph.bin", "lock",
          "common", "costs", "shares", "local", "before-relight"}) {
      if (first == own) return true;
    }
  }
  return false;
}

}  // namespace

void check_output_file(const std::string& path) {
  std::error_code code;
  if (fs::is_directory(path, code)) {
    throw InputError(path, "-o", "is a directory", "name a file in it");
  }
  if (fs::is_symlink(path, code) && fs::is_regular_file(path, code) &&
      (path.starts_with("/dev/") || path.starts_with("/proc/"))) {
    throw InputError(path, "-o", "stands for a file that is open already", "name that file itself");
  }
  if (is_kept_by_run(path))
    throw InputError(path, "-o", "is a file that the run keeps for itself", "name another file");
  fs::path parent = fs::path(path).parent_path();
  if (parent.empty()) parent = ".";
  if (!fs::is_directory(parent, code)) {
    throw InputError(path, "-o", "there is no directory " + parent.string(),
                     "make it, or name another file");
  }
  if (::access(parent.c_str(), W_OK | X_OK) != 0) {
    throw InputError(path, "-o", "cannot be written: " + std::string(std::strerror(errno)),
                     "give write permission to " + parent.string() + ", or name another file");
  }
}

void check_scene_output(const std::string& path) {
  check_output_file(path);
  if (!path.ends_with(".json")) {
    throw InputError(path, "-o", "is no name of a scene file", "let it end in .json");
  }
}

}  // namespace enfilade
