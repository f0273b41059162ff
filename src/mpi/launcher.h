#pragma once
#include <cstdlib>
#include <initializer_list>

namespace svnet {

/// Whether an MPI launcher (mpirun, srun --mpi) started this process. Read from the environment, because MPI_Init takes
/// a large part of a second.
inline bool started_by_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

}  // namespace svnet
