#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/enum_names.h"
#include "base/index.h"

namespace svnet::train {

/// A strict reading of YAML: one document of mappings, lists and scalars. Keys are names without dots, none twice in a
/// mapping; anchors, aliases and tags are errors. Every error is one line that begins with where the value stands.
struct YamlValue {
  enum class Kind { null, scalar, list, mapping };

  Kind kind = Kind::null;
  std::string key;                 ///< dotted path from the top, "scores.layer"; an item of a list is "held_out[2]"
  std::string place;               ///< "configs/demo.yaml:12", or "--set"
  int line = 0;                    ///< from 1
  std::string text;                ///< of a scalar
  bool quoted = false;             ///< a scalar in quotes is text, never a number
  std::vector<YamlValue> items{};  ///< of a list, or the values of a mapping in the order of the text

  /// "configs/demo.yaml:12: scores.layer", "--set scores.layer"
  std::string where() const;
};

/// Reads `text`. `source` is its name in errors. An empty text is null.
YamlValue parse_yaml(const std::string& text, const std::string& source);

/// Reads the value of a "key=value" override; an empty value is empty text. Errors begin with "--set KEY".
YamlValue parse_override(const std::string& assignment);

/// The numbers that a key accepts: from min to max. An open end is excluded.
struct NumberRange {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  bool min_open = false, max_open = false;
};

/// "a whole number >= 2", "a number >= 0 and < 1"
std::string described(const NumberRange& range, bool whole);
/// "one of a, b, c"
std::string described(std::span<const std::string> choices);

/// The value as a type; throws Error with its place, what it is and what was expected.
std::string yaml_text(const YamlValue& value);
/// Also takes a whole number written like 4e7.
Index yaml_whole_number(const YamlValue& value, const NumberRange& range);
double yaml_number(const YamlValue& value, const NumberRange& range);
/// The text of the value, which is one of `choices`.
std::string yaml_choice(const YamlValue& value, std::span<const std::string> choices);
template <class Enum>
Enum yaml_choice(const YamlValue& value) {
  return *find_enum<Enum>(yaml_choice(value, names_of<Enum>()));
}
/// Throws Error, beginning with `where`, unless `name` is one of `choices`.
void check_choice(const std::string& where, const std::string& name, std::span<const std::string> choices);
/// A list of texts, none twice.
std::vector<std::string> yaml_texts(const YamlValue& value);

/// A text, a number and a list of texts as parse_yaml reads them back: equal to the last bit.
std::string written_yaml(std::string_view text);
std::string written_yaml(double number);
std::string written_yaml(std::span<const std::string> texts);

}  // namespace svnet::train
