// Whether a launcher of parallel programs started this process.
#pragma once

namespace enfilade {

/// True where the environment is that of a rank which mpirun, srun or smpirun started, perhaps with
/// others beside it: one of OMPI_COMM_WORLD_SIZE (Open MPI), PMI_SIZE (MPICH, srun), PMIX_RANK
/// (srun, prterun) and SMPI_GLOBAL_SIZE (smpirun) is set.
bool started_as_rank();

}  // namespace enfilade
