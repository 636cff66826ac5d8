#include "app/frame/output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

/// True for a file in RUN that something is computed from: one in the place of it would end the
/// run.
bool is_kept_by_run(const std::string& path) {
  std::error_code code;
  const fs::path whole = fs::absolute(path, code).lexically_normal();
  const std::string name = whole.filename().string(),
                    folder = whole.parent_path().filename().string();
  const auto in_run = [&](const fs::path& run) { return fs::exists(run / "run.json", code); };
  for (const char* own : {"run.json", "scene.json", "leaks.json", "reports.json", "stats.json",
                          "history.json", "warnings.json", "assignment.json"}) {
    if (name == own) return in_run(whole.parent_path());
  }
  for (const char* own : {"common", "costs", "shares", "local"})
    if (folder == own) return in_run(whole.parent_path().parent_path());
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
