#include "app/enfilade_mpi.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "app/frame/launcher.hpp"
#include "app/frame/solve_name.hpp"
#include "base/error.hpp"

namespace enfilade {

bool needs_mpi(int argc, const char* const* argv) {
  if (started_as_rank()) return true;
  int word = 1;  // the subcommand; options before it, such as --help, concern it as well
  while (word < argc && argv[word][0] == '-') ++word;
  return word < argc && std::strcmp(argv[word], solve_name) == 0;
}

void become_enfilade_mpi(char* const* argv) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::path folder = fs::read_symlink("/proc/self/exe", unknown).parent_path();
  const fs::path beside = folder / "enfilade-mpi";
  const fs::path in_libexec = folder.parent_path() / "libexec" / "enfilade-mpi";
  std::string why;
  for (const fs::path& program : {beside, in_libexec}) {
    ::execv(program.c_str(), argv);
    if (why.empty() || errno != ENOENT) why = std::strerror(errno);
  }
  throw InputError(beside.string(), "solve and mpirun", "cannot be run: " + why,
                   "build the target enfilade-mpi, or install it beside enfilade");
}

}  // namespace enfilade
