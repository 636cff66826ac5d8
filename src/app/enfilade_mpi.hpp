// The way from `enfilade`, which links no MPI, to `enfilade-mpi`, which does.
#pragma once

namespace enfilade {

/// True for `solve`, the subcommand of all ranks, and for a process that a launcher started as one
/// rank among others: only MPI knows which of them is to do a single process's work.
bool needs_mpi(int argc, const char* const* argv);

/// Replaces this program by enfilade-mpi, with the same arguments and environment; returns only by
/// throwing. enfilade-mpi lies beside this program, links resolved, or in ../libexec. Throws
/// InputError where it does not, or cannot be run.
[[noreturn]] void become_enfilade_mpi(char* const* argv);

}  // namespace enfilade
