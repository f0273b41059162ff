#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/hdf5/file_state.h"

namespace svnet::io::hdf5 {

/// Reads all values of a dataset or attribute into `values`, converted to `memory_type`.
using Reader = std::function<herr_t(hid_t memory_type, void* values)>;

/// `count` numbers that the file stores as `type`. T is float (from floats), double (from floats and integers),
/// std::int64_t or std::uint64_t (from integers). Throws Error for an integer that does not fit.
template <class T>
std::vector<T> read_numbers(const File& file, const std::string& where, hid_t type, std::uint64_t count,
                            const Reader& read);

/// `count` strings that the file stores as `type`. Throws Error unless they are UTF-8 without NUL.
std::vector<std::string> read_texts(const File& file, const std::string& where, hid_t type, std::uint64_t count,
                                    const Reader& read);

}  // namespace svnet::io::hdf5
