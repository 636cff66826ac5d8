#include "json/model_files.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"
#include "json/json_text.hpp"
#include "json/text_encoding.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// The entry of a folder with this name: as it stands, else the first one whatever its case.
fs::path entry_of(const fs::path& folder, const fs::path& name) {
  std::error_code code;
  fs::path found;
  if (fs::exists(folder / name, code)) return folder / name;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    const fs::path entry = it->path().filename();
    if (lower_case(entry.string()) == lower_case(name.string()) && (found.empty() || entry < found))
      found = entry;
  }
  return folder / (found.empty() ? name : found);
}

struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

ModelFiles::ModelFiles(std::vector<std::string> models, bool allow_outside)
    : models_(std::move(models)), allow_outside_(allow_outside) {
  for (const std::string& model : models_)
    folders_.push_back(fs::path(canonical(model)).parent_path().string());
}

bool ModelFiles::allowed(const std::string& path) const {
  if (allow_outside_ || std::find(models_.begin(), models_.end(), path) != models_.end())
    return true;
  const std::string real = canonical(path);
  return std::any_of(folders_.begin(), folders_.end(), [&](const std::string& folder) {
    const std::string inside = folder == "/" ? "/" : folder + "/";
    return real.compare(0, inside.size(), inside) == 0;
  });
}

std::string ModelFiles::path_from(const std::string& from, const std::string& name) {
  const fs::path as_named = fs::path(from).parent_path() / name;
  std::error_code code;
  if (fs::path(name).is_absolute() || fs::exists(as_named, code)) return as_named.string();
  fs::path path = fs::path(from).parent_path();
  for (const fs::path& part : fs::path(name)) path = entry_of(path.empty() ? "." : path, part);
  return fs::exists(path, code) ? path.string() : as_named.string();
}

std::string ModelFiles::canonical(const std::string& path) {
  std::error_code code;
  const fs::path found = fs::weakly_canonical(path, code);
  return code ? fs::absolute(path, code).lexically_normal().string() : found.string();
}

bool ModelFiles::exists(const std::string& path) {
  std::error_code code;
  return fs::exists(path, code);
}

void ModelFiles::fail(const std::string& path, const Place& place, const std::string& what,
                      const std::string& hint) {
  if (path == place.file) throw InputError(path, place.where, what, hint);
  throw InputError(place.file, place.where, in_quotes(path) + " " + what, hint);
}

const std::string& ModelFiles::read(const std::string& path, const Place& place) {
  const auto known = read_.find(path);
  if (known != read_.end()) return known->second;
  if (!allowed(path)) {
    fail(path, place, "lies outside the model's folder",
         "put it beside the model, or give --allow-outside");
  }
  // Without O_NONBLOCK a pipe that nobody writes to would keep us waiting.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  if (file.number < 0) {
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    fail(path, place,
         missing ? "does not exist" : std::string("cannot be opened: ") + std::strerror(errno),
         missing ? "check the path" : "check its permissions");
  }
  struct stat status {};
  if (::fstat(file.number, &status) != 0 || !S_ISREG(status.st_mode)) {
    fail(path, place, S_ISDIR(status.st_mode) ? "is a directory" : "is no regular file",
         "name a file that holds the data itself");
  }
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size == 0) fail(path, place, "is empty", "write it again");
  if (bytes_ + size > most_bytes) {
    fail(path, place, "makes the model larger than 4 GiB", "split the model, and import its parts");
  }
  bytes_ += size;
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(file.number, bytes.data() + done, bytes.size() - done);
    if (count == 0) break;
    if (count < 0 && errno != EINTR)
      fail(path, place, std::string("cannot be read: ") + std::strerror(errno), "check the disk");
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  hash_ = XXH64(bytes.data(), bytes.size(), hash_);
  return read_.emplace(path, std::move(bytes)).first->second;
}

const std::string& ModelFiles::read_text(const std::string& path, const Place& place) {
  const std::string& bytes = read(path, place);
  if (utf16_by_mark(bytes) == nullptr) return bytes;
  return text_.try_emplace(path, file_in_utf8(bytes)).first->second;
}

}  // namespace enfilade
