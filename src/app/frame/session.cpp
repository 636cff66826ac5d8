#include "app/frame/session.hpp"

#include <csignal>
#include <new>
#include <system_error>

#include "base/error.hpp"
#include "base/memory_wanted.hpp"
#include "base/peak_memory.hpp"

namespace enfilade {
namespace {

std::string mebibytes(std::uint64_t bytes) {
  return bytes < (1u << 20) ? std::to_string(bytes) + " bytes"
                            : std::to_string(bytes >> 20) + " MiB";
}

std::string memory_ran_out() {
  const RefusedMemory refused = refused_memory();
  const std::string more = refused.bytes > 0 ? mebibytes(refused.bytes) + " more" : "more";
  const std::string purpose =
      refused.purpose[0] != 0 ? std::string(" for ") + refused.purpose.data() : "";
  return "memory: ran out: " + more + " wanted" + purpose + ", beside the " +
         mebibytes(peak_rss_bytes()) +
         " taken so far; give a smaller scene, a larger --target-error, fewer ranks or a --memory "
         "budget, or use a larger machine";
}

}  // namespace

Session::Session(bool root) : console_(root) {
  // A file that may not grow is an error of the write, not the end of the process.
  std::signal(SIGXFSZ, SIG_IGN);
}

std::string words_of(const std::exception& error) {
  const auto is = [&error]<class Error>(Error*) {
    return dynamic_cast<const Error*>(&error) != nullptr;
  };
  const std::string what = error.what();
  if (is(static_cast<std::bad_alloc*>(nullptr)) || is(static_cast<std::length_error*>(nullptr)))
    return memory_ran_out();
  if (is(static_cast<InputError*>(nullptr)) || is(static_cast<RunError*>(nullptr))) return what;
  if (is(static_cast<std::system_error*>(nullptr)))
    return "system: " + what + "; see to the system's limits, then try again";
  return "inside enfilade: " + what +
         "; this is a fault of the program: please report it, with the command and its input";
}

int Session::fail(const std::exception& error) {
  console_.error(words_of(error));
  return dynamic_cast<const InputError*>(&error) != nullptr ? bad_input_status : broken_run_status;
}

}  // namespace enfilade
