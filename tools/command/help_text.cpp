#include "command/help_text.h"

#include <sstream>

namespace svnet::command {
namespace {

constexpr std::size_t kColumns = 80, kNameColumns = 30;

/// Wraps text between words. A line exceeds `columns` only if one word does.
std::string wrapped(const std::string& text, std::size_t columns) {
  std::istringstream words(text);
  std::string result, word;
  std::size_t length = 0;
  while (words >> word) {
    const bool fits = length + 1 + word.size() <= columns;
    if (length > 0) result += fits ? ' ' : '\n';
    length = length > 0 && fits ? length + 1 + word.size() : word.size();
    result += word;
  }
  return result;
}

/// The name of a value. CLI11's types are such as "INT:INT in [1 - 1024]" and "TEXT:{zero,skip}".
std::string value_name(const std::string& type) {
  const auto colon = type.find(':');
  if (colon != std::string::npos && type.compare(colon + 1, 1, "{") == 0) return type.substr(colon + 1);
  const std::string name = type.substr(0, colon);
  return name == "INT" || name == "UINT" ? "N" : name == "FLOAT" ? "X" : name;
}

}  // namespace

HelpText::HelpText() { column_width(kNameColumns); }

std::string HelpText::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), kColumns) + "\n\n";
}

std::string HelpText::make_option_opts(const CLI::Option* option) const {
  if (option->get_positional() || option->get_type_size() == 0) return "";
  return " " + value_name(option->get_type_name());
}

std::string HelpText::make_option_desc(const CLI::Option* option) const {
  std::string text = option->get_description();
  if (option->get_required() && !option->get_positional()) text += " (required)";
  if (!option->get_default_str().empty()) text += " (default: " + option->get_default_str() + ")";
  return wrapped(text, kColumns - kNameColumns);
}

}  // namespace svnet::command
