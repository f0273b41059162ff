#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "io/hdf5/handle.h"

namespace svnet::io::hdf5 {

/// To be called before anything else of the library, and before a process is forked that uses it.
void prepare_library();

/// How files are opened: without locks, because files are replaced as a whole, and network file systems often have
/// none.
Handle access_properties();

/// A file for reading. Throws Error if the library refuses it. Callers must hold a Quiet.
Handle open_for_reading(const std::filesystem::path& path);
/// Of a file whose bytes are in memory, which must outlive the handle. Asks the operating system for nothing. `name` is
/// for messages.
Handle open_image(const std::string& name, void* bytes, std::uint64_t size);

}  // namespace svnet::io::hdf5
