#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svnet {

/// The candidate with the smallest edit distance (Levenshtein) to `name`; empty if none is near enough to be meant.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// ", did you mean 'x'?" for the nearest candidate, or "; known: a, b, c" where none is near.
std::string suggestion(std::string_view name, std::span<const std::string> candidates);

/// The items with the separator between them.
std::string joined_with(std::string_view separator, std::span<const std::string> items);

/// "99.5 %" of a share of 0.995.
std::string percent(double share);

/// Control characters become spaces: what a file's name or a library's message brings along must not reach a terminal,
/// nor break a line in two.
std::string without_control_characters(std::string_view text);

/// Whether `text` is well-formed UTF-8 (RFC 3629) without NUL, so that it can be stored and given to anyone.
bool is_plain_utf8(std::string_view text);

/// Less-than in natural order: runs of digits compare as numbers ("2" before "10"), everything else byte by byte.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace svnet
