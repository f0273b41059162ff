#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "io/hdf5/file_state.h"

namespace svnet::io::hdf5 {

/// How a dataset or attribute stores a string of variable length, little endian: its length (4 bytes), the address of a
/// collection of the global heap (8) and the index in that collection (4).
using TextReference = std::array<std::byte, 16>;

/// The memory type that reads strings of variable length as TextReference. The library's own conversion to strings is
/// not safe: up to 1.10.8 it does not check lengths and indices, and a damaged file makes it write past its buffers.
Handle text_reference_type();

/// The strings of a file's global heap ("HDF5 File Format Specification" 3.0, III.E). Every length is checked.
class GlobalHeap {
 public:
  explicit GlobalHeap(const File& file) : file_(file), text_left_(file.size), collections_left_(file.size) {}
  /// Throws Error that names `where` for an invalid reference, and if all texts together are larger than the file.
  std::string text(const TextReference& reference, const std::string& where);

 private:
  struct Collection {
    std::vector<char> bytes;
    std::map<std::uint32_t, std::span<const char>> objects;
  };
  const Collection& collection(std::uint64_t address, const std::string& where);

  const File& file_;
  std::uint64_t text_left_, collections_left_;  // bytes of the file's size that are not used up
  std::map<std::uint64_t, Collection> collections_;
};

}  // namespace svnet::io::hdf5
