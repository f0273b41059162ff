#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace svnet {

/// An object to be put into a group, and its pictures.
struct SortedObject {
  std::string name;
  std::vector<std::filesystem::path> pictures;
};

/// The objects of the arguments. A file is an object of one picture. A folder is an object whose pictures are all PNG,
/// JPEG and WebP files in it, at any depth. But a single folder stands for what is in it: each picture and each folder
/// is an object. Folders are read in natural order; names that datasets ignore (io/views/dataset_folder.h), other files
/// and folders without pictures are left out. Names are relative to a single folder, otherwise as given.
///
/// Throws Error that names the argument if it does not exist or holds no pictures.
std::vector<SortedObject> sorted_objects(const std::vector<std::filesystem::path>& arguments);

}  // namespace svnet
