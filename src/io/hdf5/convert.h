#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "io/hdf5/file_state.h"
#include "io/hdf5/request.h"

namespace svnet::io::hdf5 {

/// Reads the values of one block into `values`, converted to `memory_type`, with the transfer properties `transfer`.
using Reader = std::function<herr_t(hid_t memory_type, hid_t transfer, void* values)>;
using TakeBlock = std::function<void(std::uint64_t count, const Reader&)>;

/// The values of a dataset or attribute.
struct Source {
  std::string where;  // in messages
  hid_t type;         // in the file
  std::uint64_t count;
  /// Passes on all values in order, in blocks of up to `most` values, or of more if the file stores them in chunks.
  std::function<void(std::uint64_t most, const TakeBlock&)> read_blocks;
};

/// T is float (from floats), double (from floats and integers), std::int64_t or std::uint64_t (from integers). Throws
/// Error for an integer that does not fit.
template <class T>
void read_numbers(const File&, const Source&, Sink&);

/// Throws Error unless the strings are UTF-8 without NUL, and together not longer than the file.
void read_texts(const File&, const Source&, Sink&);

}  // namespace svnet::io::hdf5
