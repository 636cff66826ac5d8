// Work on untrusted input in a process of its own, with limits: whatever happens to it is one line
// of error here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace enfilade {

struct ProcessLimits {
  std::uint64_t memory_bytes = std::uint64_t{8} << 30;  ///< besides what this process has already
  double seconds = 600.0;
};

/// Calls `work` in a child process and returns its bytes. An InputError of `work` is thrown here as
/// it is; a crash, the end of memory or of time becomes an InputError of `file`.
std::vector<std::byte> in_own_process(const std::string& file, const ProcessLimits& limits,
                                      const std::function<std::vector<std::byte>()>& work);

/// What a program that was run wrote, and how it ended.
struct ProgramResult {
  static constexpr std::size_t most_errors = std::size_t{64} << 10;
  std::string output, errors;  ///< of `errors`, the last most_errors bytes
  int exit_status = -1;        ///< -1 where a signal ended it
  int signal = 0;
  bool timed_out = false;
};

/// Runs a program with these arguments (the first is the program) and `input` on its standard
/// input, within the limits. Throws RunError where it cannot be started.
ProgramResult run_program(const std::vector<std::string>& arguments, const std::string& input,
                          const ProcessLimits& limits);

}  // namespace enfilade
