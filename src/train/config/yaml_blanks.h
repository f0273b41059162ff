#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace svnet::train {

/// A character that looks like a space but is none to YAML, at a place from 1.
struct FalseBlank {
  long line, column;
  std::string what;  // "a tab in the indentation"
};

/// The first false blank outside quotes and comments: a tab in the indentation (YAML 1.2, section 6.1), outside of
/// brackets, or a no-break or other Unicode space anywhere.
std::optional<FalseBlank> false_blank(std::string_view yaml);

}  // namespace svnet::train
