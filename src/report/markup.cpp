#include "report/markup.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/text.h"

namespace svnet::report {
namespace {

/// The length of the UTF-8 sequence that a byte begins; 1 for bytes that begin none.
std::size_t sequence_length(unsigned char lead) {
  if (lead >= 0xf0) return 4;
  if (lead >= 0xe0) return 3;
  return lead >= 0xc0 ? 2 : 1;
}

std::string tag(std::string_view name, const Attributes& attributes) {
  std::string text = "<" + std::string(name);
  for (const Attribute& attribute : attributes)
    text += " " + std::string(attribute.name) + "=\"" + escaped(attribute.text) + "\"";
  return text;
}

std::string fixed(double value, int digits) {
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

bool is_zero(const std::string& digits) { return digits.find_first_not_of("-0.") == std::string::npos; }

}  // namespace

std::string escaped(std::string_view text) {
  constexpr const char* kReplacement = "\xef\xbf\xbd";
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::string_view sequence = text.substr(i, sequence_length(byte));
    const bool c1_control = byte == 0xc2 && sequence.size() == 2 && static_cast<unsigned char>(sequence[1]) < 0xa0;
    if (byte == '\t' || byte == '\n' || byte == '\r') {
      result += ' ';
    } else if (byte < 0x20 || byte == 0x7f || c1_control || !is_plain_utf8(sequence)) {
      result += kReplacement;
      i += c1_control ? 2 : 1;
      continue;
    } else if (byte == '&') {
      result += "&amp;";
    } else if (byte == '<') {
      result += "&lt;";
    } else if (byte == '>') {
      result += "&gt;";
    } else if (byte == '"') {
      result += "&quot;";
    } else if (byte == '\'') {
      result += "&#39;";
    } else {
      result += sequence;
    }
    i += sequence.size();
  }
  return result;
}

std::string element(std::string_view name, const Attributes& attributes, std::string_view inner) {
  return tag(name, attributes) + ">" + std::string(inner) + "</" + std::string(name) + ">";
}

std::string element(std::string_view name, std::string_view inner) { return element(name, {}, inner); }

std::string empty_element(std::string_view name, const Attributes& attributes) { return tag(name, attributes) + " />"; }

std::string svg(double width, double height, std::string_view alternative, std::string_view inner) {
  return element("svg",
                 {{"role", "img"},
                  {"aria-label", std::string(alternative)},
                  {"width", coordinate(width)},
                  {"height", coordinate(height)},
                  {"viewBox", "0 0 " + coordinate(width) + " " + coordinate(height)}},
                 inner);
}

std::string svg_text(double x, double y, std::string_view text, const char* anchor, const char* style_class) {
  Attributes attributes{{"x", coordinate(x)}, {"y", coordinate(y)}};
  if (std::string_view(anchor) != "start") attributes.push_back({"text-anchor", anchor});
  if (*style_class != 0) attributes.push_back({"class", style_class});
  return element("text", attributes, escaped(text));
}

std::string svg_line(double x1, double y1, double x2, double y2, const char* style_class) {
  return empty_element("line", {{"x1", coordinate(x1)},
                                {"y1", coordinate(y1)},
                                {"x2", coordinate(x2)},
                                {"y2", coordinate(y2)},
                                {"class", style_class}});
}

std::string svg_circle(double x, double y, double radius, const std::string& style_class) {
  return empty_element(
      "circle", {{"cx", coordinate(x)}, {"cy", coordinate(y)}, {"r", coordinate(radius)}, {"class", style_class}});
}

std::string coordinate(double value) {
  std::string text = fixed(value, 2);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string number(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  std::string text = fixed(std::abs(value), digits);
  return value < 0 && !is_zero(text) ? "−" + text : text;
}

std::string signed_number(double value, int digits) {
  const std::string text = number(value, digits);
  return std::isfinite(value) && value > 0 && !is_zero(text) ? "+" + text : text;
}

std::string shortened(std::string_view text, std::size_t most) {
  std::size_t characters = 0, kept = 0;  // kept: bytes of the first most - 1 characters
  for (std::size_t i = 0; i < text.size();) {
    i = std::min(text.size(), i + sequence_length(static_cast<unsigned char>(text[i])));
    if (++characters == most - 1) kept = i;
  }
  return characters <= most ? std::string(text) : std::string(text.substr(0, kept)) + "…";
}

}  // namespace svnet::report
