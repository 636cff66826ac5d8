// The entry point of enfilade-smpi where it is started without smpirun. smpirun loads it as a
// shared object, which has no entry point; this one prints how to start the program, on one line.
#include <unistd.h>

#include <string_view>

// The program interpreter, which makes a shared object one that the system can start; without it
// (on other processors) a start without smpirun crashes.
#if defined(__x86_64__)
// Sanitizers are not set up there either.
#define ENFILADE_START \
  __attribute__((used, force_align_arg_pointer, no_sanitize("address", "undefined")))
__attribute__((used, section(".interp"))) const char interpreter[] = "/lib64/ld-linux-x86-64.so.2";
#elif defined(__aarch64__)
#define ENFILADE_START __attribute__((used))
__attribute__((used, section(".interp"))) const char interpreter[] = "/lib/ld-linux-aarch64.so.1";
#else
#define ENFILADE_START __attribute__((used))
#endif

/// The entry point that the linker is given (src/app/CMakeLists.txt). Nothing that a C++ program
/// has at its main() is set up here, so that only system calls are safe.
extern "C" ENFILADE_START void enfilade_without_smpirun() {
  constexpr std::string_view line =
      "enfilade: error: enfilade-smpi: command line: runs under smpirun alone; start it as "
      "'smpirun -platform platforms/office.xml -hostfile platforms/office-4.hosts -np 4 "
      "enfilade-smpi solve SCENE -o RUN'\n";
  // Where the line cannot be written, the exit status remains.
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
  ::_exit(2);
}
