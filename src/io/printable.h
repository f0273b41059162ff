#pragma once
#include <string>
#include <string_view>

namespace svnet {

/// Text of a file for a message of one line: control characters become '?'.
inline std::string printable(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return result;
}

}  // namespace svnet
