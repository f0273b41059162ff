#include "io/keras/snake_case.h"

namespace svnet::io {

std::string snake_case(const std::string& class_name) {
  std::string text;
  for (std::size_t i = 0; i < class_name.size(); ++i) {
    const bool upper = class_name[i] >= 'A' && class_name[i] <= 'Z';
    const bool next_lower = i + 1 < class_name.size() && class_name[i + 1] >= 'a' && class_name[i + 1] <= 'z';
    const bool after_lower = i > 0 && class_name[i - 1] >= 'a' && class_name[i - 1] <= 'z';
    if (upper && i > 0 && (after_lower || next_lower)) text += '_';
    text += upper ? static_cast<char>(class_name[i] - 'A' + 'a') : class_name[i];
  }
  return text;
}

}  // namespace svnet::io
