#include "import/intake/own_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <span>
#include <utility>

#include "base/byte_stream.hpp"
#include "base/error.hpp"

namespace enfilade {
namespace {

constexpr std::uint64_t no_limit_from = std::uint64_t{1} << 40;

/// Bytes of address space and of data that this process has now.
std::array<std::uint64_t, 2> sizes_now() {
  unsigned long long size = 0, ignored = 0, data = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "re"); file != nullptr) {
    if (std::fscanf(file, "%llu %llu %llu %llu %llu %llu", &size, &ignored, &ignored, &ignored,
                    &ignored, &data) != 6)
      size = data = 0;
    std::fclose(file);
  }
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return {size * page, data * page};
}

/// Called in the child. The sanitizers' shadow memory counts as data: there, time alone is limited.
void limit_this_process(const ProcessLimits& limits) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const auto [size, data] = sizes_now();
  if (size < no_limit_from) {
    const rlimit memory{data + limits.memory_bytes, data + limits.memory_bytes};
    ::setrlimit(RLIMIT_DATA, &memory);
  }
  const auto cpu = static_cast<rlim_t>(limits.seconds) + 1;
  const rlimit time{cpu, cpu + 1};
  ::setrlimit(RLIMIT_CPU, &time);
}

struct Pipe {
  int read_end = -1, write_end = -1;
  Pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
      throw RunError(std::string("no pipe can be made: ") + std::strerror(errno));
    read_end = ends[0];
    write_end = ends[1];
  }
  ~Pipe() {
    close_read();
    close_write();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_read() { close_end(read_end); }
  void close_write() { close_end(write_end); }

 private:
  static void close_end(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
};

bool write_all(int to, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(to, at, size);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) {
      at += n;
      size -= static_cast<std::size_t>(n);
    }
  }
  return true;
}

/// A child process; ended and waited for when it goes out of scope.
class Child {
 public:
  Child(pid_t pid, double seconds)
      : pid_(pid),
        deadline_(std::chrono::steady_clock::now() +
                  std::chrono::milliseconds(static_cast<long long>(1000.0 * seconds))) {}
  ~Child() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    end();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Milliseconds that are left.
  int left() const {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline_ - std::chrono::steady_clock::now());
    return left.count() > 0 ? static_cast<int>(left.count()) : 0;
  }
  void kill() {
    ::kill(pid_, SIGKILL);
    timed_out_ = true;
  }
  bool timed_out() const { return timed_out_; }
  /// Waits, and returns the status of waitpid.
  int end() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = 0;
    return status;
  }

 private:
  pid_t pid_;
  std::chrono::steady_clock::time_point deadline_;
  bool timed_out_ = false;
};

/// One end of a pipe, and the bytes that go through it.
struct Flow {
  int end;
  std::string* received;  ///< null where bytes are sent
  std::string_view to_send;
  bool keeps_end_alone = false;  ///< the last ProgramResult::most_errors bytes
};

void keep_end(std::string& text) {
  if (text.size() > ProgramResult::most_errors)
    text.erase(0, text.size() - ProgramResult::most_errors);
}

/// Reads and writes until every flow is at its end; kills the child when its time is over.
void carry(std::vector<Flow> flows, Child& child) {
  std::vector<char> buffer(std::size_t{1} << 16);
  while (!flows.empty()) {
    std::vector<pollfd> waiting;
    for (const Flow& flow : flows)
      waiting.push_back({flow.end, static_cast<short>(flow.received ? POLLIN : POLLOUT), 0});
    const int ready = ::poll(waiting.data(), waiting.size(), child.left());
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return child.kill();
    for (std::size_t i = flows.size(); i-- > 0;) {
      if (waiting[i].revents == 0) continue;
      Flow& flow = flows[i];
      ssize_t n = 0;
      if (flow.received != nullptr) {
        n = ::read(flow.end, buffer.data(), buffer.size());
        if (n > 0) flow.received->append(buffer.data(), static_cast<std::size_t>(n));
        if (flow.keeps_end_alone) keep_end(*flow.received);
      } else {
        n = ::write(flow.end, flow.to_send.data(), flow.to_send.size());
        if (n > 0) flow.to_send.remove_prefix(static_cast<std::size_t>(n));
        if (flow.to_send.empty()) n = 0;
      }
      const bool again = n < 0 && (errno == EINTR || errno == EAGAIN);
      if (n > 0 || again) continue;
      if (flow.received == nullptr) ::close(flow.end);
      flows.erase(flows.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

constexpr char answer = 'A', refusal = 'R', out_of_memory = 'M', other_fault = 'F';

/// The child's part: the answer, or what was thrown, as bytes on the pipe.
[[noreturn]] void work_and_end(int pipe, const std::function<std::vector<std::byte>()>& work) {
  ByteWriter fault;
  char kind = answer;
  std::vector<std::byte> bytes;
  try {
    bytes = work();
  } catch (const InputError& e) {
    kind = refusal;
    fault.put_text(e.file());
    fault.put_text(e.where());
    fault.put_text(e.what());
    bytes = fault.take();
  } catch (const std::bad_alloc&) {
    kind = out_of_memory;
  } catch (const std::exception& e) {
    kind = other_fault;
    fault.put_text(e.what());
    bytes = fault.take();
  }
  const bool written =
      write_all(pipe, &kind, 1) && (bytes.empty() || write_all(pipe, bytes.data(), bytes.size()));
  ::_exit(written ? 0 : 1);
}

/// The InputError whose message was "file: where: what; hint".
[[noreturn]] void throw_again(ByteReader in) {
  const std::string file = in.get_text(), where = in.get_text();
  const std::string text = in.get_text().substr(file.size() + where.size() + 4);
  const std::size_t split = text.rfind("; ");
  throw InputError(file, where, text.substr(0, split),
                   split == std::string::npos ? std::string() : text.substr(split + 2));
}

[[noreturn]] void fail_for(const std::string& file, const std::string& what) {
  throw InputError(file, "file", what, "import parts of the model, or export it anew");
}

[[noreturn]] void fail_for_memory(const std::string& file, const ProcessLimits& limits) {
  fail_for(file, "needs more than " + std::to_string(limits.memory_bytes >> 20) +
                     " MiB of memory to import");
}

}  // namespace

std::vector<std::byte> in_own_process(const std::string& file, const ProcessLimits& limits,
                                      const std::function<std::vector<std::byte>()>& work) {
  Pipe pipe;
  const pid_t pid = ::fork();
  if (pid < 0) throw RunError(std::string("no process can be started: ") + std::strerror(errno));
  if (pid == 0) {
    pipe.close_read();
    // Handlers of this program or of MPI would write their own reports of a crash.
    for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTERM, SIGXCPU})
      std::signal(signal, SIG_DFL);
    limit_this_process(limits);
    work_and_end(pipe.write_end, work);
  }
  Child child(pid, limits.seconds);
  pipe.close_write();
  std::string received;
  carry({{pipe.read_end, &received, {}}}, child);
  const int status = child.end();
  if (child.timed_out() || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
    fail_for(file, "takes more than " + std::to_string(static_cast<int>(limits.seconds)) +
                       " s to import");
  }
  if (WIFSIGNALED(status))
    fail_for(file, std::string("crashed its reader (") + ::strsignal(WTERMSIG(status)) + ")");
  if (received.empty()) fail_for(file, "ended its reader without an answer");
  const std::span<const std::byte> bytes = std::as_bytes(std::span(received)).subspan(1);
  if (received[0] == refusal) throw_again(ByteReader(bytes, "the reader's error"));
  if (received[0] == out_of_memory) fail_for_memory(file, limits);
  if (received[0] == other_fault) {
    throw RunError(file +
                   ": cannot be imported: " + ByteReader(bytes, "the reader's error").get_text());
  }
  return {bytes.begin(), bytes.end()};
}

ProgramResult run_program(const std::vector<std::string>& arguments, const std::string& input,
                          const ProcessLimits& limits) {
  Pipe in, out, errors;
  std::vector<char*> words;
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const pid_t pid = ::fork();
  if (pid < 0) throw RunError(std::string("no process can be started: ") + std::strerror(errno));
  if (pid == 0) {
    limit_this_process(limits);
    ::dup2(in.read_end, 0);
    ::dup2(out.write_end, 1);
    ::dup2(errors.write_end, 2);
    ::execvp(words[0], words.data());
    ::_exit(127);
  }
  Child child(pid, limits.seconds);
  in.close_read();
  out.close_write();
  errors.close_write();
  // A reader that ends early must not end this process.
  struct sigaction ignore {
  }, before{};
  ignore.sa_handler = SIG_IGN;
  ::sigaction(SIGPIPE, &ignore, &before);
  ::fcntl(in.write_end, F_SETFL, O_NONBLOCK);
  ProgramResult result;
  const int sending = std::exchange(in.write_end, -1);
  carry({{sending, nullptr, input},
         {out.read_end, &result.output, {}},
         {errors.read_end, &result.errors, {}, true}},
        child);
  const int status = child.end();
  ::sigaction(SIGPIPE, &before, nullptr);
  result.timed_out = child.timed_out();
  if (WIFEXITED(status)) result.exit_status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

}  // namespace enfilade
