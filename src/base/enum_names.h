#pragma once
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace svnet {

/// The names of an enum's values, each once, for files, YAML, command line, Python and messages. An enum has a table if
/// its own namespace has a function enum_table:
///   constexpr auto enum_table(Linkage) {
///     return std::to_array<EnumName<Linkage>>({{Linkage::ward, "ward"}, {Linkage::average, "average"}});
///   }
template <class Enum>
struct EnumName {
  Enum value;
  const char* name;
};

/// Whether the enum has a table of names.
template <class Enum>
inline constexpr bool has_enum_names = requires {
  enum_table(Enum{});
};

template <class Enum>
inline constexpr auto enum_names = enum_table(Enum{});

/// Requires a table that has the value.
template <class Enum>
constexpr const char* name_of(Enum value) {
  static_assert(has_enum_names<Enum>, "write enum_table for this enum, in its namespace");
  const auto entry = std::find_if(enum_names<Enum>.begin(), enum_names<Enum>.end(),
                                  [value](const EnumName<Enum>& e) { return e.value == value; });
  assert(entry != enum_names<Enum>.end());
  return entry->name;
}

/// All names, in the order of the table.
template <class Enum>
std::vector<std::string> names_of() {
  static_assert(has_enum_names<Enum>, "write enum_table for this enum, in its namespace");
  std::vector<std::string> names;
  names.reserve(enum_names<Enum>.size());
  for (const EnumName<Enum>& entry : enum_names<Enum>) names.emplace_back(entry.name);
  return names;
}

/// The value of that name, if the table has it: for callers with a message of their own.
template <class Enum>
std::optional<Enum> find_enum(const std::string& name) {
  static_assert(has_enum_names<Enum>, "write enum_table for this enum, in its namespace");
  for (const EnumName<Enum>& entry : enum_names<Enum>)
    if (name == entry.name) return entry.value;
  return {};
}

/// Throws Error "<what>: '<name>' is none of a, b, c", with the nearest known name if one is near.
template <class Enum>
Enum enum_from_name(const std::string& what, const std::string& name) {
  if (const std::optional<Enum> value = find_enum<Enum>(name)) return *value;
  const std::vector<std::string> names = names_of<Enum>();
  const std::string nearest = nearest_name(name, names);
  fail(what, ": '", name, "' is none of ", joined_with(", ", names),
       nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

}  // namespace svnet
