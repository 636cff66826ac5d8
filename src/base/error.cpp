#include "base/error.hpp"

namespace enfilade {

InputError::InputError(std::string file, std::string where, std::string what, std::string hint)
    : std::runtime_error(file + ": " + where + ": " + what + "; " + hint),
      file_(std::move(file)),
      where_(std::move(where)) {}

void check_failed(const char* condition, const char* file, int line, const std::string& operands) {
  // The file's name alone: its folder is that of whoever built the program.
  const std::string path(file);
  throw CheckFailure(path.substr(path.rfind('/') + 1) + ":" + std::to_string(line) +
                     ": check failed: " + condition + " (" + operands + ")");
}

}  // namespace enfilade
