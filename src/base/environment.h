#pragma once
#include <string>

// The environment. environment.cpp is the only file that reads it, and nothing changes it. Programs and interfaces read
// it at their edges (the frame of the commands, the C interface, the Python module) and pass on what it says as
// arguments. The variables:
//   SVNET_THREADS      threads of Parallel::shared(), read when it is first used
//   SVNET_MAX_ISA      the best instruction set that svnet's own kernels may use (base/cpu.h)
//   SVNET_PRECISION    f32, bf16 or int8 (nn/runtime/inference_options.h)
//   SVNET_CONVOLUTION  direct or winograd (likewise)
//   TMPDIR             the folder for temporary files, if not /tmp
//   TERM               whether progress is drawn as a bar
//   DISPLAY, WAYLAND_DISPLAY: whether there is a desktop that can show a report
//   OMPI_COMM_WORLD_SIZE, PMIX_RANK, PMI_RANK, PMI_SIZE, MV2_COMM_WORLD_SIZE: set by MPI launchers
// OPENBLAS_CORETYPE, which chooses the kernels of OpenBLAS, is read by OpenBLAS itself.
namespace svnet {

/// The value of a variable; "" if it is unset.
std::string environment_variable(const char* name);

/// Whether an MPI launcher (mpirun, srun --mpi) started this process. Cheaper than to start MPI, which takes a good
/// part of a second.
bool started_by_launcher();

/// The number of processes that the launcher says it started; 1 if it does not say.
int launched_processes();

}  // namespace svnet
