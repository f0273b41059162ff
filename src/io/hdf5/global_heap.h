#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "file_state.h"

namespace svnet::hdf5 {

/// A string of variable length as a dataset or attribute holds it: its length (4 bytes), the address of a collection of
/// the global heap (8) and its number there (4), little endian.
using TextReference = std::array<std::byte, 16>;

/// The type in memory that strings of variable length are read to when they are wanted as references.
///
/// The library's own conversion is not used for files from outside: up to 1.10.8 it trusts lengths and numbers, and
/// writes past its buffers where they lie.
Handle text_reference_type();

/// The strings of a file's global heap ("HDF5 File Format Specification" 3.0, III.E), every length checked.
class GlobalHeap {
 public:
  explicit GlobalHeap(const File& file) : file_(file), text_left_(file.size), collections_left_(file.size) {}
  /// Throws Error that names `where` if the reference leads nowhere, or if more text was asked for than the file holds.
  std::string text(const TextReference& reference, const std::string& where);

 private:
  struct Collection {
    std::vector<char> bytes;
    std::map<std::uint32_t, std::span<const char>> objects;
  };
  const Collection& collection(std::uint64_t address, const std::string& where);

  const File& file_;
  std::uint64_t text_left_, collections_left_;  // bytes that the file can hold and that were not asked for yet
  std::map<std::uint64_t, Collection> collections_;
};

}  // namespace svnet::hdf5
