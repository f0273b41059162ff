#pragma once
#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "temporary_folder.h"

namespace svnet {

/// Whether tests can start several processes. Warns if not.
inline bool can_run_ranks() {
#ifdef SVNET_HAS_MPI
  if (std::system("mpirun --version >/dev/null 2>&1") == 0) return true;
  WARN("skipped: there is no mpirun");
#else
  WARN("skipped: built without MPI");
#endif
  return false;
}

/// The command line that runs `command` as `ranks` processes on this machine.
inline std::string with_ranks(int ranks, const std::string& command) {
  // A folder of its own for each mpirun: if several share one, one may remove it while another creates it.
  static const TemporaryFolder folder;
  // Open MPI does not free the memory of its plug-ins; that is not a leak of svnet.
  return "TMPDIR=" + folder.path().string() + " ASAN_OPTIONS=detect_leaks=0 mpirun -n " + std::to_string(ranks) +
         " --allow-run-as-root --bind-to none --oversubscribe --mca mpi_yield_when_idle 1 " + command;
}

}  // namespace svnet
