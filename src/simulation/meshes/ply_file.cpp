#include "ply_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "text_words.h"

namespace svnet::simulation {
namespace {

/// Takes the next line of a text body that is not blank; empty at the end.
std::string_view take_body_line(std::string_view& text) {
  constexpr std::string_view kEnds("\n\r\f\0", 4), kBetween("\n\r\f\0 \t", 6);
  text.remove_prefix(std::min(text.find_first_not_of(kBetween), text.size()));
  const std::string_view line = text.substr(0, text.find_first_of(kEnds));
  text.remove_prefix(line.size());
  return line;
}

/// Takes the next line of the header, with its end.
std::string_view take_header_line(const std::string& name, std::string_view& file) {
  std::string_view line = file.substr(0, file.find('\n'));
  file.remove_prefix(std::min(line.size() + 1, file.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  check(std::all_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) >= ' ' || c == '\t'; }),
        name, ": the header holds a control character; do its lines end with LF or CR LF?");
  return line;
}

PlyType type_of(std::string_view word) {
  static constexpr std::pair<std::string_view, PlyType> kTypes[]{
      {"char", {1, false, true}},    {"int8", {1, false, true}},    {"uchar", {1, false, false}},
      {"uint8", {1, false, false}},  {"short", {2, false, true}},   {"int16", {2, false, true}},
      {"ushort", {2, false, false}}, {"uint16", {2, false, false}}, {"int", {4, false, true}},
      {"int32", {4, false, true}},   {"uint", {4, false, false}},   {"uint32", {4, false, false}},
      {"float", {4, true, true}},    {"float32", {4, true, true}},  {"double", {8, true, true}},
      {"float64", {8, true, true}}};
  for (const auto& [name, type] : kTypes)
    if (word == name) return type;
  return {};
}

/// What follows the word "property".
bool parse(std::string_view words, PlyProperty& property) {
  const std::string_view type = take_word(words);
  if (type == "list") property.length = type_of(take_word(words));
  property.type = type_of(type == "list" ? take_word(words) : type);
  property.name = std::string(take_word(words));
  return property.type.bytes > 0 && (type != "list" || property.length.bytes > 0);
}

}  // namespace

int PlyElement::find(std::initializer_list<std::string_view> names) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (std::find(names.begin(), names.end(), properties[i].name) != names.end()) return static_cast<int>(i);
  return -1;
}

PlyHeader take_ply_header(const std::string& name, std::string_view& file) {
  const std::size_t size = file.size();
  std::string_view first = take_header_line(name, file);
  const std::string_view magic = take_word(first);
  check(magic == "ply" || magic == "PLY", name, ": is not a PLY file; its first line is not 'ply'");
  PlyHeader header;
  for (;;) {
    check(!file.empty(), name, ": the header has no end_header; is the file cut off?");
    const std::string_view line = take_header_line(name, file);
    std::string_view words = line;
    const std::string_view key = take_word(words);
    if (key == "end_header") return header;
    if (key == "format") {
      const std::string_view format = take_word(words);
      header.format = format == "ascii"                  ? PlyHeader::Format::text
                      : format == "binary_little_endian" ? PlyHeader::Format::little_endian
                                                         : PlyHeader::Format::big_endian;
    } else if (key == "comment") {
      if (take_word(words) == "TextureFile") header.textures.emplace_back(trimmed(words));
    } else if (key == "element") {
      PlyElement element{std::string(take_word(words)), 0, {}};
      check(parse_number(take_word(words), element.count), name, ": '", printable(line), "' has no number of elements");
      check(element.count <= size, name, ": promises ", element.count, " of '", printable(element.name), "' in ", size,
            " bytes; is the file incomplete?");
      header.elements.push_back(std::move(element));
    } else if (key == "property") {
      PlyProperty property;
      check(!header.elements.empty() && parse(words, property), name, ": '", printable(line),
            "' is not a property of an element");
      header.elements.back().properties.push_back(std::move(property));
    }
  }
}

bool PlyBody::take(const PlyElement& element, PlyRow& row) {
  row.resize(element.properties.size());
  if (format_ == PlyHeader::Format::text) return take_text(element, row);
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    double count = 1;
    if (property.length.bytes > 0) {
      if (rest_.size() < property.length.bytes) return false;
      count = take_number(property.length);
    }
    if (!(count >= 0) || count > static_cast<double>(rest_.size() / property.type.bytes)) return false;
    row[i].resize(static_cast<std::size_t>(count));
    for (double& value : row[i]) value = take_number(property.type);
  }
  return true;
}

bool PlyBody::take_text(const PlyElement& element, PlyRow& row) {
  std::string_view line = take_body_line(rest_);
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    std::uint64_t count = 1;
    if (element.properties[i].length.bytes > 0 && !parse_number(take_word(line), count)) return false;
    row[i].clear();
    for (; count > 0; --count) {
      double value = 0;
      if (!parse_signed(take_word(line), value)) return false;
      row[i].push_back(value);
    }
  }
  return true;
}

double PlyBody::take_number(const PlyType& type) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type.bytes; ++i)
    bits =
        bits << 8 | static_cast<std::uint8_t>(rest_[format_ == PlyHeader::Format::big_endian ? i : type.bytes - 1 - i]);
  rest_.remove_prefix(type.bytes);
  if (type.is_float)
    return type.bytes == 8 ? std::bit_cast<double>(bits)
                           : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  if (!type.is_signed) return static_cast<double>(bits);
  const std::size_t shift = 64 - 8 * type.bytes;
  return static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
}

}  // namespace svnet::simulation
