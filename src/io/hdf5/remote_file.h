#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "io/hdf5/request.h"
#include "sandbox/child.h"

namespace svnet::io::hdf5 {

/// A file that a child process reads, which has the HDF5 library, the open file and nothing else.
class RemoteFile {
 public:
  /// `size` is that of the file. Throws Error if it cannot be opened, or there can be no such process.
  RemoteFile(const std::filesystem::path& path, std::uint64_t size);

  /// Throws the Error that the child met. If the child did not survive it, all further calls throw the same.
  void answer(const Request&, Sink&);

 private:
  std::string name_;
  std::unique_ptr<sandbox::Child> child_;
  std::string failure_;  // of a child that is gone; empty: memory was missing
};

}  // namespace svnet::io::hdf5
