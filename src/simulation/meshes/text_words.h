#pragma once
#include <algorithm>
#include <string_view>

#include "base/text.h"

// Lines and words of mesh files that are text. Each take_ function removes what it returns from the front of the text.
namespace svnet::simulation {

constexpr std::string_view kBlanks = " \t\r\f\v";

inline std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// The text without the byte order mark that some programs begin UTF-8 with.
inline std::string_view without_byte_order_mark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

/// Up to the next LF, CR or CR LF, without it.
inline std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find_first_of("\n\r"));
  text.remove_prefix(line.size());
  text.remove_prefix(std::min<std::size_t>(text.starts_with("\r\n") ? 2 : 1, text.size()));
  return line;
}

/// Empty at the end.
inline std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

/// As parse_number, with a plus sign before it too.
template <class Number>
bool parse_signed(std::string_view word, Number& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  return parse_number(word, number);
}

}  // namespace svnet::simulation
