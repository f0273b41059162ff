#pragma once
#include <charconv>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace svnet {

/// The candidate with the smallest edit distance (Levenshtein) to `name`; empty if none is similar enough.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// ", did you mean 'x'?" for the nearest candidate, or "; known: a, b, c" if none is near.
std::string suggestion(std::string_view name, std::span<const std::string> candidates);

/// The items with the separator between them.
std::string joined_with(std::string_view separator, std::span<const std::string> items);

/// "99.5 %" for 0.995.
std::string percent(double share);

/// Makes text of a file or of another library safe for a terminal. Tabs and line breaks become spaces, other control
/// characters become '?'.
char printable(char c);
std::string printable(std::string_view text);

/// The text with A to Z in lower case.
std::string lower_case(std::string_view text);

/// Sets `number` and returns true if all of `text` is a number, without spaces. The locale does not matter.
template <class Number>
bool parse_number(std::string_view text, Number& number) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, number);
  return result.ec == std::errc() && result.ptr == end;
}

/// Whether `text` is well-formed UTF-8 (RFC 3629) without NUL, so that any program can read it.
bool is_plain_utf8(std::string_view text);

/// Less-than in natural order: runs of digits compare as numbers ("2" before "10"), everything else byte by byte.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace svnet
