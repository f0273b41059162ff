#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace svnet::attacks {

/// A file that was made to attack who reads it.
struct Attack {
  std::string name;            // what it tries
  std::filesystem::path file;  // what is given to svnet-info, or the collection that is given to svnet-render
  std::uint64_t bytes = 0;     // of all its files
};

/// Write the corpus into a folder: the same bytes each time.
std::vector<Attack> write_hdf5_attacks(const std::filesystem::path& folder);
std::vector<Attack> write_mesh_attacks(const std::filesystem::path& folder);

}  // namespace svnet::attacks
