#pragma once
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "mpi/mpi_communicator.h"
#include "temporary_folder.h"

namespace svnet {

/// Whether tests can start several processes; says why not.
inline bool can_run_ranks() {
  if (!built_with_mpi()) {
    WARN("skipped: built without MPI");
    return false;
  }
  if (std::system("mpirun --version >/dev/null 2>&1") != 0) {
    WARN("skipped: there is no mpirun");
    return false;
  }
  return true;
}

/// The command line that runs `command` as so many processes on this machine.
inline std::string with_ranks(int ranks, const std::string& command) {
  // Where all mpirun of a machine share a folder, one may remove it while another makes it.
  static const TemporaryFolder folder;
  // Open MPI leaves memory of its plug-ins behind, which is no leak of ours.
  return "TMPDIR=" + folder.path().string() + " ASAN_OPTIONS=detect_leaks=0 mpirun -n " + std::to_string(ranks) +
         " --allow-run-as-root --bind-to none --oversubscribe --mca mpi_yield_when_idle 1 " + command;
}

}  // namespace svnet
