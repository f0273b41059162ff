// Features, scores and unfinished scores, which are all HDF5.
#include "io/views/features_file.h"
#include "io/views/scores_file.h"
#include "memory_file.h"

using namespace svnet;
using namespace svnet::fuzz;

SVNET_FUZZ_TARGET(hdf5_tables) {
  const MemoryFile file(input);
  accept([&] { io::read_features_origin(file.path()); });
  accept([&] { io::read_features(file.path()); });
  accept([&] { io::read_scores(file.path()); });
  accept([&] { io::read_scores_snapshot(file.path()); });
}
