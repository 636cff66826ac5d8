// The two errors a user can meet, and the check for the ones only a programmer can cause.
#pragma once

#include <stdexcept>
#include <string>

namespace enfilade {

/// Bad input: exit status 2 and one line "FILE: WHERE: what is wrong; what to do".
class InputError : public std::runtime_error {
 public:
  InputError(std::string file, std::string where, std::string what, std::string hint);

  const std::string& file() const { return file_; }
  const std::string& where() const { return where_; }

 private:
  std::string file_;
  std::string where_;
};

/// A failure while running: exit status 1, the last committed iteration intact.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A programmer's fault that a check found. what() says where in the sources, for those who mend
/// it.
class CheckFailure : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws CheckFailure naming the failed condition; behind ENFILADE_CHECK.
[[noreturn]] void check_failed(const char* condition, const char* file, int line,
                               const std::string& operands);

}  // namespace enfilade

/// A check that is on in every build; throws std::logic_error. `operands` is a std::string with the
/// values that broke the condition.
#define ENFILADE_CHECK(condition, operands)                                               \
  do {                                                                                    \
    if (!(condition)) ::enfilade::check_failed(#condition, __FILE__, __LINE__, operands); \
  } while (false)
