#include "import/ifc/ifc_program.hpp"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"
#include "import/intake/own_process.hpp"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

/// Beside the executable's folder, as `cmake --install` lays it; else where it was built.
std::string script() {
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  const fs::path installed = program.parent_path().parent_path() / ENFILADE_IFC_READER_INSTALLED;
  if (!code && fs::exists(installed, code)) return (installed / "read_ifc.cjs").string();
  return ENFILADE_IFC_READER_BUILT "/read_ifc.cjs";
}

/// Node's own limit of memory comes first: past it, V8 ends the program with a line that says so. A
/// house of 1 MiB takes two seconds; on some faulty files web-ifc has no end.
ProcessLimits limits_for(std::size_t bytes) {
  const double mib = static_cast<double>(bytes) / (1 << 20);
  return {std::uint64_t{6} << 30, std::min(9.0 + 60.0 * mib, 570.0)};
}
constexpr const char* heap_limit = "--max-old-space-size=4096";
constexpr int not_found = 127;

}  // namespace

std::string run_ifc_program(const std::string& file, const std::string& bytes) {
  const auto fail = [&](const std::string& what, const std::string& hint) {
    throw InputError(file, "file", what, hint);
  };
  const std::string reader = script();
  const ProcessLimits limits = limits_for(bytes.size());
  ProgramResult result = run_program({"node", heap_limit, reader}, bytes, limits);
  if (result.exit_status == not_found)
    fail("needs Node.js to be imported, which is not installed",
         "install it (apt-get install nodejs npm), then configure and build Enfilade again");
  const bool memory = result.errors.find("out of memory") != std::string::npos ||
                      result.errors.find("Out of memory") != std::string::npos ||
                      result.errors.find("bad_alloc") != std::string::npos;
  if (result.timed_out || result.signal == SIGXCPU)
    fail("takes more than " + std::to_string(static_cast<int>(limits.seconds)) + " s to import",
         "import parts of the model, or export it anew");
  if (memory)
    fail("needs more memory to import than its reader may have", "import parts of the model");
  if (result.signal != 0)
    fail(std::string("crashed its reader (") + ::strsignal(result.signal) + ")",
         "export it anew, or import parts of the model");
  if (result.exit_status != 0 || result.output.empty())
    fail("ended its reader without an answer (exit status " + std::to_string(result.exit_status) +
             ")",
         "check that " + reader + " is there, or export the model anew");
  return std::move(result.output);
}

}  // namespace enfilade
