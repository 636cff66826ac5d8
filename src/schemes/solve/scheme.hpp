// The names of the parallel schemes: the paper's, and its two rivals (§2).
#pragma once

#include <span>
#include <string>

namespace enfilade {

/// spmd          every rank reads and writes the clusters' files and goes through its own CYCLE;
///               stealing and the token ring (§3.2; spmd_scheme.hpp)
/// master_slave  the group iteration of [6] (§2.1; group_dealer.hpp)
/// replicated    the CV-sets of [8] (§2.2; cell_dealer.hpp)
/// The latter two have a master, rank 0, that owns the files and deals out the work
/// (master_scheme.hpp). All gather with the same kernels and count with the same counters.
/// A new scheme is a subclass of ParallelScheme, a name here and a line in make_scheme.cpp.
enum class Scheme { spmd, master_slave, replicated };
/// Returns the names on the command line, in the enum's order: spmd, master-slave, replicated.
std::span<const char* const> scheme_names();
const char* name_of(Scheme scheme);
/// Returns the scheme of this name. Throws InputError for a name that is none of these.
Scheme scheme_of(const std::string& name);

}  // namespace enfilade
