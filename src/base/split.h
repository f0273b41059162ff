#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace svnet {

/// The parts of a text between separators: one more than there are separators, and some may be empty.
inline std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0, end; begin <= text.size(); begin = end + 1) {
    end = std::min(text.find(separator, begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
  }
  return parts;
}

}  // namespace svnet
