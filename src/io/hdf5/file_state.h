#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/index.h"
#include "io/hdf5/error_stack.h"
#include "io/hdf5/handle.h"
#include "io/hdf5/limits.h"

namespace svnet::io::hdf5 {

/// The place of an object or attribute, for messages: "'a/b'", "attribute 'x' of 'a/b'".
std::string object_place(const std::string& object);
std::string attribute_place(const std::string& object, const std::string& name);

/// The parts of a path between slashes.
std::vector<std::string> path_parts(const std::string& path);

struct Extent {
  std::vector<Index> shape;
  std::uint64_t count = 1;  // the product of the shape
};

/// An open file, shared by the functions of Hdf5File. Its caller must hold a Quiet.
struct File {
  std::string name{};      // in messages
  std::uint64_t size = 0;  // in bytes, of a file that is read
  Handle file{};

  /// Throws "FILE: WHERE: parts".
  template <class... Parts>
  [[noreturn]] void fail_at(const std::string& where, const Parts&... parts) const {
    fail(name, ": ", where, ": ", parts...);
  }
  /// Returns the result of an HDF5 call. Throws Error with `what` and the library's reason if the call failed.
  template <class Result>
  Result done(Result result, const std::string& where, const char* what) const {
    if (result < 0) fail_at(where, what, ": ", reason());
    return result;
  }

  /// Follows hard links from the root. Throws Error if a part of the path is missing or a link of another kind.
  Handle object(const std::string& path) const;
  Handle group(const std::string& path) const;
  /// A dataset that is safe to read. Throws Error unless all its values are stored in this file, with known filters.
  Handle dataset(const std::string& path) const;
  Handle attribute(const std::string& object, const std::string& attribute_name) const;
  Extent extent(hid_t space, const std::string& where) const;
};

}  // namespace svnet::io::hdf5
