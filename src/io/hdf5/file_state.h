#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/index.h"
#include "error_stack.h"
#include "handle.h"

namespace svnet::hdf5 {

/// No dataset or attribute may need more memory than this.
inline constexpr std::uint64_t kLargestBytes = std::uint64_t{1} << 36;
/// Deflate compresses at most 1032 to 1 (zlib's technical details).
inline constexpr std::uint64_t kLargestCompression = 1040;

/// Where, for messages: "'a/b'", "attribute 'x' of 'a/b'".
std::string object_place(const std::string& object);
std::string attribute_place(const std::string& object, const std::string& name);

/// The parts of a path between slashes.
std::vector<std::string> path_parts(const std::string& path);

struct Extent {
  std::vector<Index> shape;
  std::uint64_t count = 1;  // the product of the shape
};

/// An open file: what the functions of Hdf5File share. They hold a Quiet while they run.
struct File {
  std::string name;        // in messages
  std::uint64_t size = 0;  // in bytes, of a file that is read
  int descriptor = -1;     // of a file that is read
  std::uint64_t base = 0;  // where addresses count from: a file may begin with a block that is not HDF5's
  Handle file;             // last: closed first

  /// Throws "FILE: WHERE: parts".
  template <class... Parts>
  [[noreturn]] void fail_at(const std::string& where, const Parts&... parts) const {
    fail(name, ": ", where, ": ", parts...);
  }
  /// Passes on what an HDF5 call returned; if it failed, throws what could not be done and why.
  template <class Result>
  Result done(Result result, const std::string& where, const char* what) const {
    if (result < 0) fail_at(where, what, ": ", reason());
    return result;
  }

  /// Finds out descriptor and base of a file that was opened for reading.
  void look_up_layout();
  /// Bytes of a file that is read, as they lie there.
  std::vector<char> bytes(std::uint64_t address, std::uint64_t count, const std::string& where) const;

  /// Follows hard links from the root; fails if a part of the path is missing or a link of another kind.
  Handle object(const std::string& path) const;
  Handle group(const std::string& path) const;
  /// A dataset that may be read: its values lie in this file, behind known filters, as many as it declares.
  Handle dataset(const std::string& path) const;
  Handle attribute(const std::string& object, const std::string& attribute_name) const;
  Extent extent(hid_t space, const std::string& where) const;
};

}  // namespace svnet::hdf5
