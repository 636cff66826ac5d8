// Name and one-line help of `solve`. `enfilade` lists it, and leaves it to `enfilade-mpi`, which
// links MPI.
#pragma once

namespace enfilade {

inline constexpr const char* solve_name = "solve";
inline constexpr const char* solve_description =
    "Compute the light of a scene, on as many ranks as mpirun starts";

}  // namespace enfilade
