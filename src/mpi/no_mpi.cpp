#include <iostream>

#include "base/environment.h"
#include "mpi/mpi_communicator.h"

namespace svnet {

int main_with_communicator(int argc, char** argv, const char* name,
                           int (*run)(int argc, char** argv, Communicator& communicator)) {
  if (started_by_launcher()) {
    std::cerr << name
              << ": started by mpirun or srun, but built without MPI; install libopenmpi-dev and build again, or start "
                 "it as one process"
              << std::endl;
    return 1;
  }
  SingleProcess single_process;
  return run(argc, argv, single_process);
}

}  // namespace svnet
