#include "serve/field_values.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"

namespace svnet::serve {
namespace {

/// A value as messages show it.
std::string shown(std::string_view text) { return printable(text.substr(0, 40)); }

}  // namespace

std::vector<double> numbers_in(const std::string& field, std::string_view text) {
  std::vector<double> numbers;
  for (bool more = true; more;) {
    const std::string_view item = text.substr(0, text.find(','));
    more = item.size() < text.size();
    text.remove_prefix(std::min(text.size(), item.size() + 1));
    double number = 0;
    expect(parse_number(item, number) && std::isfinite(number), 400, field, ": '", shown(item), "' is not a number");
    numbers.push_back(number);
  }
  return numbers;
}

FieldValues::FieldValues(const Fields& fields) : left_(fields) {
  for (auto field = left_.begin(); field != left_.end(); ++field)
    for (auto other = left_.begin(); other != field; ++other)
      expect(field->first != other->first, 400, "the field ", shown(field->first), " is there twice");
}

std::optional<std::string> FieldValues::take(const std::string& name) {
  known_.push_back(name);
  const auto field = std::ranges::find(left_, name, &Fields::value_type::first);
  if (field == left_.end()) return {};
  std::string value = std::move(field->second);
  left_.erase(field);
  return value;
}

double FieldValues::number(const std::string& name, double otherwise) {
  const std::optional<std::string> text = take(name);
  if (!text) return otherwise;
  const std::vector<double> numbers = numbers_in(name, *text);
  expect(numbers.size() == 1, 400, name, ": '", shown(*text), "' is not a number");
  return numbers.front();
}

void FieldValues::check_all_taken() const {
  if (!left_.empty())
    refuse(400, "the field ", shown(left_.front().first), " is not known here",
           suggestion(left_.front().first, known_));
}

void FieldValues::refuse_choice(const std::string& name, const std::string& value,
                                const std::vector<std::string>& known) {
  refuse(400, name, ": '", shown(value), "' is not known", suggestion(value, known));
}

}  // namespace svnet::serve
