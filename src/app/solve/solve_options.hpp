// The options of `solve`, and the solver's configuration that they come to.
#pragma once

#include <string>
#include <vector>

#include "schemes/solve/solve.hpp"

namespace CLI {
class App;
}

namespace enfilade {

struct SolveOptions {
  std::string input, output;
  std::string replay;  ///< RUN whose recorded gathers take the place of the kernels
  double target_error = SolveConfig{}.target_error;
  std::string target_error_at;  ///< probe file; empty = everywhere
  std::string relight;          ///< scene file; empty = none
  double epsilon = 0.0, tolerance = 0.0;
  std::optional<std::uint64_t> patch_links;
  std::string basis = "linear", scheme = "spmd", assignment = "kmeans",
              order = "travelling-salesman";
  std::string oracle = "error", visibility = "exact";
  std::string iteration = "hybrid", hierarchy = "building";
  std::string memory, memory_manager = "own", local_directory, cost_model;
  std::uint64_t seed = SolveConfig{}.seed;
  int max_iterations = SolveConfig{}.max_iterations;
  bool trace = false, no_steal = false, no_correction = false, resume = false, quiet = false;
  bool allow_outside = false;
  bool pictures = true, rooms = false, walk = true, shares = false;
  std::vector<std::string> given;  ///< options that stood on the command line
  std::vector<std::string> notes;  ///< lines about options that have another name now

  /// Empty where the input is a RUN directory that is solved in place.
  std::string scene_file() const;
  std::string run_directory() const;
  /// Returns whether the user chose the basis: `--basis auto` leaves the choice to the program.
  bool basis_is_given() const;
  bool target_is_given() const { return gave("--target-error"); }
  bool order_is_given() const { return gave("--order"); }
  /// Throws InputError for values that are none or that do not go together.
  /// The points of `target_error_at` are left out: one rank reads their file for all.
  SolveConfig config() const;

 private:
  void check_replay() const;
  void check_relight() const;
  /// Throws InputError for options that the chosen scheme ignores.
  void check_scheme() const;
  bool gave(const std::string& option) const;
};

/// Examples below the options in `enfilade solve --help`.
extern const char* const solve_footer;

/// Adds the arguments and options of `solve`. Parsing fills `options`, its `given` and `notes`
/// included.
void add_solve_options(CLI::App& sub, SolveOptions& options);

}  // namespace enfilade
