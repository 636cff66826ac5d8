#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "base/posix_file.hpp"

namespace enfilade {
namespace {

constexpr std::string_view ending = ".part-";
constexpr std::size_t random_digits = 16;

/// 16 hexadecimal digits that no other process can foresee.
std::string random_name() {
  std::uint64_t number = 0;
  while (::getrandom(&number, sizeof number, 0) != sizeof number) {
  }
  char digits[random_digits + 1];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(number));
  return digits;
}

/// A device or a pipe: nothing can be renamed over it.
bool is_stream(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 &&
         (S_ISCHR(info.st_mode) || S_ISFIFO(info.st_mode) || S_ISSOCK(info.st_mode));
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  // O_NONBLOCK: a pipe that nobody reads would never open; it is replaced as a file would be.
  constexpr int flags = O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK;
  if (is_stream(path_)) {
    fd_ = ::open(path_.c_str(), flags);
    if (fd_ < 0 && errno != ENXIO) fail(errno);
    if (fd_ >= 0 && ::fcntl(fd_, F_SETFL, 0) != 0) fail(errno);
  }
  if (fd_ < 0) open_beside();
}

void AtomicFile::open_beside() {
  constexpr int tries = 8;  // a name that is taken is as good as impossible
  for (int i = 0; i < tries; ++i) {
    temporary_ = path_ + std::string(ending) + random_name();
    fd_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd_ >= 0) return;
    if (errno != EEXIST) break;
  }
  const int code = errno;
  temporary_.clear();
  fail(code);
}

AtomicFile::~AtomicFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::add(std::string_view text) {
  write_all(fd_, path_, std::as_bytes(std::span(text)));
}

void AtomicFile::commit(bool durable) {
  if (durable && !temporary_.empty() && ::fsync(fd_) != 0) fail(errno);
  // A disk of the network may tell only now that it is full.
  if (::close(std::exchange(fd_, -1)) != 0) fail(errno);
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void AtomicFile::fail(int code) { fail_to_write(path_, code); }

void replace_file(const std::string& path, std::string_view text) {
  AtomicFile file(path);
  file.add(text);
  file.commit(false);
}

void write_file_atomically(const std::string& path, std::string_view text) {
  AtomicFile file(path);
  file.add(text);
  file.commit(true);
}

bool is_unfinished_file(std::string_view name) {
  const std::size_t at = name.rfind(ending);
  if (at == std::string_view::npos || at == 0) return false;
  const std::string_view digits = name.substr(at + ending.size());
  return digits.size() == random_digits &&
         digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

void remove_unfinished_files(const std::string& directory) {
  namespace fs = std::filesystem;
  std::error_code code;
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, code)) {
    if (is_unfinished_file(entry.path().filename().string())) found.push_back(entry.path());
  }
  for (const fs::path& path : found) fs::remove(path, code);
}

}  // namespace enfilade
