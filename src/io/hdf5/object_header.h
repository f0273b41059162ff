#pragma once
#include <cstdint>
#include <string>

#include "file_state.h"

namespace svnet::hdf5 {

/// Throws Error if, in the object header at `address`, an attribute, fill value, dataspace, layout or filter list
/// declares more bytes than its message has. Up to 1.10.8 the library decodes these without looking ("HDF5 File Format
/// Specification" 3.0, IV.A). Headers of version 2 are left to their checksum.
void check_object_header(const File& file, std::uint64_t address, const std::string& where);

}  // namespace svnet::hdf5
