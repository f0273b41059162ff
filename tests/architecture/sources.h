#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

// The project's own C++ sources as the architecture test sees them. All paths are relative to the project's folder.
namespace svnet {

struct SourceFile {
  std::string path;                   // "src/view/camera.cpp"
  std::vector<std::string> lines;     // without their ends
  std::vector<std::string> includes;  // the included files that exist in src/: "src/view/camera.h"
};

/// All .h and .cpp files in `folders` of the project `root`, sorted by path.
std::vector<SourceFile> read_sources(const std::filesystem::path& root, const std::vector<std::string>& folders);

/// The path without its extension: camera.h and camera.cpp are one unit.
std::string unit_of(const std::string& path);

/// A directed graph over names: from each node to the nodes that it needs.
using Arrows = std::map<std::string, std::set<std::string>>;

/// The groups of at least two nodes that reach each other, each sorted by name.
std::vector<std::vector<std::string>> circles(const Arrows&);

}  // namespace svnet
