#include "json/input_file.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "base/error.hpp"
#include "json/text_encoding.hpp"

namespace enfilade {
namespace {

constexpr std::chrono::seconds patience{5};  ///< for somebody to open the other end of a FIFO
constexpr std::size_t chunk_bytes = std::size_t{1} << 16;

class InputFile {
 public:
  explicit InputFile(const std::string& path) : path_(path) {
    // Without O_NONBLOCK, a FIFO that nobody writes to would never open.
    fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (fd_ < 0) {
      if (errno == ENOENT) fail("does not exist", "check the path");
      fail(std::string("cannot be opened: ") + std::strerror(errno), "check its permissions");
    }
  }
  ~InputFile() { ::close(fd_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::string read() {
    check_kind();
    std::array<char, chunk_bytes> chunk;
    const auto give_up = std::chrono::steady_clock::now() + patience;
    while (true) {
      const ssize_t n = ::read(fd_, chunk.data(), chunk.size());
      if (n > 0) {
        add({chunk.data(), static_cast<std::size_t>(n)});
      } else if (n < 0 && errno == EAGAIN) {
        written_to_ = true;  // somebody holds the other end, and has not written yet
        wait(-1);
      } else if (n < 0 && errno != EINTR) {
        fail(std::string("cannot be read to its end: ") + std::strerror(errno), "check the disk");
      } else if (n == 0 && (!pipe_ || written_to_)) {
        break;
      } else if (n == 0 && std::chrono::steady_clock::now() > give_up) {
        fail("is a pipe that nobody writes to", "start the program that writes it, or name a file");
      } else if (n == 0) {
        wait(10);
      }
    }
    if (text_.empty()) fail("is empty", "write it again");
    return std::move(text_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw InputError(path_, "file", what, hint);
  }

  void check_kind() {
    struct stat info {};
    if (::fstat(fd_, &info) != 0) fail("cannot be read", "check the disk");
    if (S_ISDIR(info.st_mode)) fail("is a directory", "give the path of a file in it");
    pipe_ = S_ISFIFO(info.st_mode) || S_ISSOCK(info.st_mode);
    if (!pipe_ && !S_ISREG(info.st_mode)) {
      fail(::isatty(fd_) != 0 ? "is a terminal" : "is a device", "give a file or a pipe");
    }
    size_ = pipe_ ? 0 : static_cast<std::size_t>(info.st_size);
    if (size_ > machine_bytes()) too_large(size_);
    text_.reserve(size_);
  }

  static std::size_t machine_bytes() {
    return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) *
           static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  }

  [[noreturn]] void too_large(std::size_t bytes) const {
    fail("holds " + std::to_string(bytes >> 20) + " MiB or more, and this machine's memory is " +
             std::to_string(machine_bytes() >> 20) + " MiB",
         "give a smaller file, or use a larger machine");
  }

  void add(std::string_view bytes) {
    written_to_ = true;
    if (text_.size() + bytes.size() > machine_bytes() / 2 && pipe_) too_large(text_.size());
    text_ += bytes;
  }

  void wait(int milliseconds) const {
    struct pollfd other_end {
      fd_, POLLIN, 0
    };
    ::poll(&other_end, 1, milliseconds);
  }

  std::string path_, text_;
  int fd_ = -1;
  bool pipe_ = false;
  bool written_to_ = false;  ///< somebody has opened the pipe to write
  std::size_t size_ = 0;
};

}  // namespace

std::string read_text(const std::string& path) { return file_in_utf8(InputFile(path).read()); }

}  // namespace enfilade
