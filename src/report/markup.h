#pragma once
#include <string>
#include <string_view>
#include <vector>

// A small writer of HTML and SVG. Functions return markup; what is called `text` is escaped, what is called `inner` is
// markup already.
namespace svnet::report {

/// Text as it stands in contents of elements and in attributes with double quotes. Characters with a meaning in markup
/// are escaped; bytes that are not UTF-8 and control characters become U+FFFD, tabs and line breaks spaces.
std::string escaped(std::string_view text);

struct Attribute {
  const char* name;
  std::string text;
};
using Attributes = std::vector<Attribute>;

/// <name attributes>inner</name>
std::string element(std::string_view name, const Attributes& attributes, std::string_view inner);
std::string element(std::string_view name, std::string_view inner);

/// <name attributes>: an element without contents, such as <img> or, in SVG, <circle />.
std::string empty_element(std::string_view name, const Attributes& attributes);

/// An SVG image of that size in pixels, which shrinks to fit. `alternative`: what it shows, in words.
std::string svg(double width, double height, std::string_view alternative, std::string_view inner);

/// Text in an SVG image. `anchor`: start, middle or end.
std::string svg_text(double x, double y, std::string_view text, const char* anchor = "start",
                     const char* style_class = "");
std::string svg_line(double x1, double y1, double x2, double y2, const char* style_class);
std::string svg_circle(double x, double y, double radius, const std::string& style_class);

/// The width of a plot in pixels: it fits on a phone.
inline constexpr double kPlotWidth = 352;

/// `side` x `side` pixels and so on, as attributes and coordinates are written: at most two decimals, no exponent.
std::string coordinate(double value);

/// A number with `digits` decimals and a true minus sign; "–" if it is not finite.
std::string number(double value, int digits = 3);
/// The same with a sign, "+0.061".
std::string signed_number(double value, int digits = 3);

/// The text, or its beginning and "…" if it has more than `most` characters.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace svnet::report
