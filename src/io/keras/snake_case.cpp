#include "io/keras/snake_case.h"

namespace svnet::io {

std::string snake_case(const std::string& class_name) {
  const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
  std::string text;
  for (std::size_t i = 0; i < class_name.size(); ++i) {
    const bool upper = class_name[i] >= 'A' && class_name[i] <= 'Z';
    const bool next_lower = i + 1 < class_name.size() && is_lower(class_name[i + 1]);
    const bool after_lower = i > 0 && is_lower(class_name[i - 1]);
    if (upper && i > 0 && (after_lower || next_lower)) text += '_';
    text += upper ? static_cast<char>(class_name[i] - 'A' + 'a') : class_name[i];
  }
  return text;
}

}  // namespace svnet::io
