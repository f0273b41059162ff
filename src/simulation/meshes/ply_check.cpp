// PLY: a header of lines that declares elements and their properties, then the elements one after the other, as lines
// of numbers or packed. Lists carry their length before them. G. Turk, The PLY Polygon File Format, 1994.
#include "ply_check.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text.h"

namespace svnet {
namespace {

enum class Format { text, little_endian, big_endian };

/// A number, or where `length_bytes` is not 0 a list of them.
struct Property {
  std::size_t bytes, length_bytes;
};

struct Element {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties;
};

struct Header {
  Format format;
  std::vector<Element> elements;
};

constexpr std::string_view kBlanks = " \t";

/// Takes the next line of a text body that is not blank from the front of `text`; empty at the end. The line ends are
/// those that Assimp takes for one.
std::string_view take_line(std::string_view& text) {
  constexpr std::string_view kEnds("\n\r\f\0", 4), kBetween("\n\r\f\0 \t", 6);
  text.remove_prefix(std::min(text.find_first_not_of(kBetween), text.size()));
  const std::string_view line = text.substr(0, text.find_first_of(kEnds));
  text.remove_prefix(line.size());
  return line;
}

/// Takes the next line of the header, with its end, from the front of `file`. Assimp crashes on some headers that hold
/// a CR, FF or NUL elsewhere.
std::string_view take_header_line(const std::string& name, std::string_view& file) {
  std::string_view line = file.substr(0, file.find('\n'));
  file.remove_prefix(std::min(line.size() + 1, file.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  check(std::all_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) >= ' ' || c == '\t'; }),
        name, ": the header holds a control character; do its lines end with LF or CR LF?");
  return line;
}

/// Takes the next word from the front of `line`; empty at the end.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

/// The bytes of a value of a type, 0 where there is no such type.
std::size_t bytes_of(std::string_view type) {
  for (const auto& [name, bytes] :
       {std::pair("char", 1), std::pair("int8", 1), std::pair("uchar", 1), std::pair("uint8", 1), std::pair("short", 2),
        std::pair("int16", 2), std::pair("ushort", 2), std::pair("uint16", 2), std::pair("int", 4),
        std::pair("int32", 4), std::pair("uint", 4), std::pair("uint32", 4), std::pair("float", 4),
        std::pair("float32", 4), std::pair("double", 8), std::pair("float64", 8)})
    if (type == name) return static_cast<std::size_t>(bytes);
  return 0;
}

/// What follows the word "property".
bool parse(std::string_view words, Property& property) {
  const std::string_view type = take_word(words);
  property.length_bytes = type == "list" ? bytes_of(take_word(words)) : 0;
  property.bytes = bytes_of(type == "list" ? take_word(words) : type);
  return property.bytes > 0 && (type != "list" || property.length_bytes > 0);
}

/// Takes the header from the front of `file`.
Header take_header(const std::string& name, std::string_view& file) {
  const std::size_t size = file.size();
  std::string_view first = take_header_line(name, file);
  const std::string_view magic = take_word(first);
  check(magic == "ply" || magic == "PLY", name, ": is not a PLY file; its first line is not 'ply'");
  Header header{Format::text, {}};
  for (;;) {
    check(!file.empty(), name, ": the header has no end_header; is the file cut off?");
    const std::string_view line = take_header_line(name, file);
    std::string_view words = line;
    const std::string_view key = take_word(words);
    if (key == "end_header") return header;
    if (key == "format") {
      const std::string_view format = take_word(words);
      header.format = format == "ascii"                  ? Format::text
                      : format == "binary_little_endian" ? Format::little_endian
                                                         : Format::big_endian;
    } else if (key == "element") {
      Element element{std::string(take_word(words)), 0, {}};
      check(parse_number(take_word(words), element.count), name, ": '", printable(line), "' has no number of elements");
      check(element.count <= size, name, ": promises ", element.count, " of '", printable(element.name), "' in ", size,
            " bytes; is the file incomplete?");
      header.elements.push_back(std::move(element));
    } else if (key == "property") {
      Property property{};
      check(!header.elements.empty() && parse(words, property), name, ": '", printable(line),
            "' is not a property of an element");
      header.elements.back().properties.push_back(property);
    }
  }
}

/// Elements as lines of numbers.
class TextBody {
 public:
  explicit TextBody(std::string_view rest) : rest_(rest) {}

  /// Takes an element; false where it is not all there.
  bool take(const Element& element) {
    std::string_view line = take_line(rest_);
    for (const Property& property : element.properties) {
      std::uint64_t values = 1;
      if (property.length_bytes > 0 && !parse_number(take_word(line), values)) return false;
      for (; values > 0; --values)
        if (take_word(line).empty()) return false;
    }
    return true;
  }

 private:
  std::string_view rest_;
};

/// Elements packed without gaps.
class PackedBody {
 public:
  PackedBody(std::string_view rest, bool big_endian) : rest_(rest), big_endian_(big_endian) {}

  bool take(const Element& element) {
    for (const Property& property : element.properties) {
      if (rest_.size() < property.length_bytes) return false;
      const std::uint64_t values = property.length_bytes > 0 ? take_number(property.length_bytes) : 1;
      if (values > rest_.size() / property.bytes) return false;
      rest_.remove_prefix(values * property.bytes);
    }
    return true;
  }

 private:
  /// A negative number is taken for one that is too large.
  std::uint64_t take_number(std::size_t bytes) {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < bytes; ++i)
      number = number << 8 | static_cast<std::uint8_t>(rest_[big_endian_ ? i : bytes - 1 - i]);
    rest_.remove_prefix(bytes);
    return number;
  }

  std::string_view rest_;
  bool big_endian_;
};

template <class Body>
void check_body(const std::string& name, const Header& header, Body body) {
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    for (std::uint64_t i = 0; i < element.count; ++i)
      if (!body.take(element))
        fail(name, ": holds ", i, " of ", element.count, " elements '", printable(element.name),
             "'; is the file incomplete?");
  }
}

}  // namespace

void check_ply(const std::string& name, std::string_view file) {
  const Header header = take_header(name, file);
  if (header.format == Format::text)
    check_body(name, header, TextBody(file));
  else
    check_body(name, header, PackedBody(file, header.format == Format::big_endian));
}

}  // namespace svnet
