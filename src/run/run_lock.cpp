#include "run/run_lock.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace enfilade {
namespace {

// The bytes of the file that are locked: by the one that writes or those that read, and by the
// ranks of a run.
constexpr int use = 0, ranks = 1;
constexpr int patience_s = 5;

std::string path_in(const std::string& run_directory) { return run_directory + "/lock"; }

struct flock piece(short type, int place) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = place;
  lock.l_len = 1;
  return lock;
}

std::string this_process() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(::getpid()) + " on " + host.data();
}

[[noreturn]] void refuse_run(const std::string& run_directory, const std::string& what) {
  throw InputError(run_directory, "lock", what,
                   "wait until it ends, or name another directory with -o");
}

}  // namespace

RunLock::~RunLock() {
  if (fd_ < 0) return;
  // Whose name stands there is gone; the same command leaves the same bytes.
  [[maybe_unused]] const bool wiped = writes_ && ::ftruncate(fd_, 0) == 0;
  ::close(fd_);
}

void RunLock::open(const std::string& run_directory, int flags) {
  const std::string path = path_in(run_directory);
  fd_ = ::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (fd_ < 0 && errno != ENOENT && errno != ENOTDIR) {
    throw RunError(path + ": cannot be opened: " + std::strerror(errno) +
                   "; see to its permissions, and that it is no link");
  }
}

bool RunLock::take(short type, int place, int seconds) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  while (true) {
    struct flock lock = piece(type, place);
    if (::fcntl(fd_, F_OFD_SETLK, &lock) == 0) return true;
    if (errno != EAGAIN && errno != EACCES && errno != EINTR) {
      fault_ = std::string("this file system keeps no locks (") + std::strerror(errno) +
               "): see that no other command writes into the directory meanwhile";
      return true;
    }
    if (std::chrono::steady_clock::now() >= give_up) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void RunLock::let_go(int place) {
  struct flock lock = piece(F_UNLCK, place);
  ::fcntl(fd_, F_OFD_SETLK, &lock);
}

void RunLock::write(const std::string& run_directory) {
  if (fd_ >= 0) return;
  open(run_directory, O_RDWR | O_CREAT);
  if (fd_ < 0) throw RunError(path_in(run_directory) + ": there is no such directory; make it");
  struct flock other = piece(F_WRLCK, use);
  const bool asked = ::fcntl(fd_, F_OFD_GETLK, &other) == 0;
  const bool writes = asked && other.l_type == F_WRLCK;
  if (!take(F_WRLCK, use, writes ? 0 : patience_s)) {
    std::array<char, 300> holder{};
    const ssize_t n = ::pread(fd_, holder.data(), holder.size() - 1, 0);
    refuse_run(run_directory, writes && n > 0
                                  ? std::string("is being written by ") + holder.data()
                                  : std::string("is being read or written by another command"));
  }
  if (!take(F_WRLCK, ranks, patience_s))
    refuse_run(run_directory, "ranks of a run that has died are still at work there");
  let_go(ranks);
  for (const char* folder : {"", "/common", "/pictures"})
    remove_unfinished_files(run_directory + folder);
  writes_ = true;
  const std::string holder = this_process();
  // For messages alone: whether it can be written does not matter.
  [[maybe_unused]] const bool told =
      ::ftruncate(fd_, 0) == 0 && ::pwrite(fd_, holder.data(), holder.size(), 0) > 0;
}

void RunLock::read(const std::string& run_directory) {
  open(run_directory, O_RDONLY);
  if (fd_ < 0) return;  // nobody has written here since there are locks
  if (take(F_RDLCK, use, 0)) return;
  std::array<char, 300> holder{};
  const ssize_t n = ::pread(fd_, holder.data(), holder.size() - 1, 0);
  refuse_run(run_directory, "is being written by " + (n > 0 ? std::string(holder.data())
                                                            : std::string("another command")));
}

void RunLock::join(const std::string& run_directory) {
  if (fd_ < 0) open(run_directory, O_RDWR);
  if (fd_ >= 0 && !take(F_RDLCK, ranks, patience_s))
    refuse_run(run_directory, "another run begins there");
}

}  // namespace enfilade
