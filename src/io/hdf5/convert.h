#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "file_state.h"

namespace svnet::hdf5 {

/// Reads a whole dataset or attribute, converted to a type in memory.
using Reader = std::function<herr_t(hid_t memory_type, void* values)>;

/// `count` numbers of the file type `type`. T: float (from floats), double (from floats and integers), std::int64_t and
/// std::uint64_t (from integers that fit; others throw Error).
template <class T>
std::vector<T> read_numbers(const File& file, const std::string& where, hid_t type, std::uint64_t count,
                            const Reader& read);

/// `count` strings of the file type `type`. Throws Error unless they are UTF-8 without NUL.
std::vector<std::string> read_texts(const File& file, const std::string& where, hid_t type, std::uint64_t count,
                                    const Reader& read);

}  // namespace svnet::hdf5
