#include <iostream>

#include "launcher.h"
#include "mpi/mpi_team.h"

namespace svnet {

bool built_with_mpi() { return false; }

int main_of_team(int argc, char** argv, const char* name, int (*run)(int argc, char** argv, Team& team)) {
  if (started_by_launcher()) {
    std::cerr << name
              << ": started by mpirun or srun, but built without MPI; install libopenmpi-dev and build again, or start "
                 "it as one process"
              << std::endl;
    return 1;
  }
  Alone alone;
  return run(argc, argv, alone);
}

}  // namespace svnet
