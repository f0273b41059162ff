#pragma once
#include <cstdint>
#include <string>

#include "io/hdf5/file_state.h"

namespace svnet::io::hdf5 {

/// Throws Error if an attribute, fill value, dataspace, layout or filter list in the object header at `address`
/// declares more bytes than its message has ("HDF5 File Format Specification" 3.0, IV.A). Up to 1.10.8 the library does
/// not check this. Headers of version 2 are not read here: they have a checksum.
void check_object_header(const File& file, std::uint64_t address, const std::string& where);

}  // namespace svnet::io::hdf5
