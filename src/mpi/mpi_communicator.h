#pragma once
#include "base/communicator.h"

namespace svnet {

/// The main function of a program whose processes share the work. Calls `run` with the communicator of the processes
/// that mpirun or srun started, or of this process alone. `name`: of the program, for messages.
///
/// Returns the status of `run`. If it is not 0, all processes of the communicator are ended, because the others would
/// wait for this one. Returns 1 if a launcher of another MPI started the process, one that is not the MPI of the build,
/// or any in a build without MPI: each process would do the whole work.
int main_with_communicator(int argc, char** argv, const char* name,
                           int (*run)(int argc, char** argv, Communicator& communicator));

}  // namespace svnet
