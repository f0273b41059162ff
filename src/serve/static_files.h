#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svnet::serve {

/// A file of the folder page/ that is part of the program.
struct StaticFile {
  std::string path;  // "/page/page.js"; "/" for index.html, "/openapi.json"
  std::string type;  // of its contents, for Content-Type
  std::string_view contents;
};

/// All files, in no particular order.
const std::vector<StaticFile>& static_files();

/// The file of a path; null if there is none.
const StaticFile* static_file(std::string_view path);

}  // namespace svnet::serve
