#pragma once
#include "base/communicator.h"

namespace svnet {

/// Whether this build knows MPI.
bool built_with_mpi();

/// The main function of a program whose processes share the work: runs `run` with the processes that mpirun or srun
/// started, or alone, and returns its status. Where it is not 0 the whole communicator ends: the others would wait for
/// this process. A build without MPI refuses to be one of several processes.
int main_with_communicator(int argc, char** argv, const char* name,
                           int (*run)(int argc, char** argv, Communicator& communicator));

}  // namespace svnet
