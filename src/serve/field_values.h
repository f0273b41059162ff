#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/enum_names.h"
#include "serve/message.h"
#include "serve/refusal.h"

namespace svnet::serve {

/// The numbers of a list such as "0.4,0,0.05". Throws Refusal 400 that names the field for anything else.
std::vector<double> numbers_in(const std::string& field, std::string_view text);

/// The fields of a request, taken one by one.
class FieldValues {
 public:
  /// Throws Refusal 400 if a field is there twice.
  explicit FieldValues(const Fields&);

  std::optional<std::string> take(const std::string& name);
  /// Throws Refusal 400 unless the value is a finite number.
  double number(const std::string& name, double otherwise);
  /// Throws Refusal 400 unless the value is a name of the enum.
  template <class Enum>
  Enum choice(const std::string& name, Enum otherwise);

  /// Throws Refusal 400 that names a field that was not taken.
  void check_all_taken() const;

 private:
  [[noreturn]] static void refuse_choice(const std::string& name, const std::string& value,
                                         const std::vector<std::string>& known);

  Fields left_;
  std::vector<std::string> known_;
};

template <class Enum>
Enum FieldValues::choice(const std::string& name, Enum otherwise) {
  const std::optional<std::string> value = take(name);
  if (!value) return otherwise;
  if (const auto found = find_enum<Enum>(*value)) return *found;
  refuse_choice(name, *value, names_of<Enum>());
}

}  // namespace svnet::serve
