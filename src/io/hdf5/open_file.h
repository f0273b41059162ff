#pragma once
#include <memory>
#include <string>

#include "io/hdf5/file_state.h"
#include "io/hdf5/remote_file.h"

namespace svnet::io::hdf5 {

/// What an Hdf5File holds: a file that this process reads or writes, or one that a child process reads.
struct OpenFile {
  File here;  // its name and size in any case
  std::unique_ptr<RemoteFile> elsewhere{};

  void answer(const Request&, Sink&) const;
};

}  // namespace svnet::io::hdf5
