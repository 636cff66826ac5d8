#include "base/posix_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace enfilade {
namespace {

std::string remedy(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return "free some space, then go on with --resume";
    case EACCES:
    case EPERM:
    case EROFS:
      return "give write permission there, or name another directory";
    case ENOENT:
      return "the run directory is not complete: prepare it again";
    case ELOOP:
      return "no link is followed there: remove it";
    case ENXIO:
      return "a pipe is in its place: remove it, then go on with --resume";
    case EFBIG:
      return "raise the limit of a file's size (ulimit -f), then go on with --resume";
    default:
      return "see to the disk, then go on with --resume";
  }
}

[[noreturn]] void fail(const std::string& path, const char* doing, int code) {
  throw RunError(path + ": " + doing + ": " + std::strerror(code) + "; " + remedy(code));
}

/// Closes what was opened.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags, const char* doing)
      : fd_(::open(path.c_str(), flags, 0644)) {
    if (fd_ < 0) fail(path, doing, errno);
  }
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

}  // namespace

void fail_to_write(const std::string& path, int code) {
  throw RunError(path + ": cannot be written: " + std::strerror(code) + "; " +
                 (code == ENOENT ? "see that its directory exists" : remedy(code)));
}

void write_all(int fd, const std::string& path, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_to_write(path, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

std::vector<std::byte> read_part(const std::string& path, std::uint64_t offset, std::size_t most) {
  // O_NONBLOCK: a pipe in the file's place would wait for its writer.
  const Descriptor file(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK, "cannot be read");
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) fail(path, "cannot be read", errno);
  if (!S_ISREG(info.st_mode))
    throw RunError(path + ": is no file; remove it, then prepare the run again");
  const auto size = static_cast<std::uint64_t>(info.st_size);
  std::vector<std::byte> bytes(std::min<std::uint64_t>(most, size - std::min(size, offset)));
  std::size_t have = 0;
  while (have < bytes.size()) {
    const ssize_t n = ::pread(file.get(), bytes.data() + have, bytes.size() - have,
                              static_cast<off_t>(offset + have));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, "cannot be read", errno);
    if (n == 0) break;
    have += static_cast<std::size_t>(n);
  }
  bytes.resize(have);
  return bytes;
}

std::vector<std::byte> read_file(const std::string& path) {
  return read_part(path, 0, std::numeric_limits<std::size_t>::max());
}

void write_file(const std::string& path, std::span<const std::byte> head,
                std::span<const std::byte> body) {
  // Over the old content rather than into a new file: creating one costs a file system a hundred
  // times more.
  // O_NONBLOCK: a pipe in the file's place would wait for its reader.
  const Descriptor file(path, O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK,
                        "cannot be written");
  write_all(file.get(), path, head);
  write_all(file.get(), path, body);
  struct stat info {};
  const auto size = static_cast<off_t>(head.size() + body.size());
  if (::fstat(file.get(), &info) != 0) fail(path, "cannot be written", errno);
  if (S_ISREG(info.st_mode) && info.st_size > size && ::ftruncate(file.get(), size) != 0) {
    fail(path, "cannot be written", errno);
  }
}

void exchange_file(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_EXCHANGE) == 0) return;
  move_file(from, to);  // `to` does not exist yet, or the file system cannot exchange
}

void move_file(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) == 0) return;
  if (errno != EXDEV) fail(to, "cannot be put in place", errno);
  constexpr std::size_t piece_bytes = std::size_t{1} << 20;
  AtomicFile copy(to);
  for (std::uint64_t done = 0;;) {
    const std::vector<std::byte> bytes = read_part(from, done, piece_bytes);
    if (bytes.empty()) break;
    copy.add({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    done += bytes.size();
  }
  copy.commit(false);
  ::unlink(from.c_str());
}

void flush_to_disk(const std::string& directory) {
  const Descriptor descriptor(directory, O_RDONLY | O_CLOEXEC, "cannot be read");
  if (::syncfs(descriptor.get()) != 0) fail(directory, "cannot be flushed to the disk", errno);
}

void make_directory(const std::string& path) {
  namespace fs = std::filesystem;
  // A rank that is done may take the empty parent away at any time: both steps are then repeated.
  // No rank does so twice, so the tries end soon; a second bounds them.
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(1);
  const fs::path parent = fs::path(path).parent_path();
  std::error_code code;
  do {
    if (!parent.empty()) fs::create_directories(parent, code);
    fs::create_directory(path, code);
  } while (code == std::errc::no_such_file_or_directory &&
           std::chrono::steady_clock::now() < give_up);
  if (code || !fs::is_directory(path)) {
    fail(path, "cannot be made a directory", code ? code.value() : ENOTDIR);
  }
}

void remove_directory(const std::string& path) {
  std::error_code code;
  std::filesystem::remove_all(path, code);
  if (code) fail(path, "cannot be removed", code.value());
}

}  // namespace enfilade
