#pragma once
#include "io/hdf5/file_state.h"
#include "io/hdf5/request.h"

namespace svnet::io::hdf5 {

/// Reads what was asked for with the HDF5 library. Throws Error that names file and object. Its caller must hold a
/// Quiet.
void answer(const File&, const Request&, Sink&);

}  // namespace svnet::io::hdf5
