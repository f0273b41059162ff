// The format of NumPy's .npy files: "\x93NUMPY", version, length of the header, a Python dictionary, then the array.
// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/text.h"
#include "image/depth_unit.h"
#include "io/images/image_codecs.h"

namespace svnet::io {
namespace {

static_assert(std::endian::native == std::endian::little);

struct Header {
  std::string type;  // "<f4"
  bool by_columns = false;
  std::vector<Index> shape;
  std::size_t size = 0;  // bytes before the array
};

[[noreturn]] void fail_damaged_npy(const std::string& name, const char* what) {
  fail(name, ": is a damaged NumPy file (", what, "); replace the file");
}

/// What follows `key` in the dictionary; empty if the key is missing.
std::string_view value_of(std::string_view dictionary, std::string_view key) {
  const auto at = dictionary.find(joined("'", key, "':"));
  if (at == std::string_view::npos) return "";
  std::string_view value = dictionary.substr(at + key.size() + 3);
  value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
  return value;
}

std::vector<Index> shape_in(const std::string& name, std::string_view tuple) {
  std::vector<Index> shape;
  if (!tuple.starts_with('(')) fail_damaged_npy(name, "its header names no shape");
  const char *at = tuple.data() + 1, *end = tuple.data() + tuple.size();
  while (at != end && *at != ')') {
    Index length = 0;
    const auto read = std::from_chars(at, end, length);
    if (read.ec != std::errc() || length < 0) fail_damaged_npy(name, "its header names no shape");
    shape.push_back(length);
    at = read.ptr;
    while (at != end && (*at == ',' || *at == ' ' || *at == 'L')) ++at;
  }
  return shape;
}

Header header_of(const std::string& name, Bytes file) {
  if (file.size() < 12) fail_damaged_npy(name, "it ends within its header");
  const std::size_t prefix = file[6] == 1 ? 10 : 12;
  std::size_t length = file[8] | file[9] << 8;
  if (prefix == 12) length |= static_cast<std::size_t>(file[10]) << 16 | static_cast<std::size_t>(file[11]) << 24;
  if (length > file.size() - prefix) fail_damaged_npy(name, "it ends within its header");
  const std::string_view dictionary(reinterpret_cast<const char*>(file.data()) + prefix, length);
  Header header;
  header.size = prefix + length;
  header.by_columns = value_of(dictionary, "fortran_order").starts_with("True");
  const std::string_view type = value_of(dictionary, "descr");
  if (type.starts_with('\'')) header.type = type.substr(1, type.find('\'', 1) - 1);
  header.shape = shape_in(name, value_of(dictionary, "shape"));
  return header;
}

double half_value(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double size = exponent == 0    ? std::ldexp(fraction, -24)
                      : exponent == 31 ? (fraction == 0 ? INFINITY : NAN)
                                       : std::ldexp(1024 + fraction, exponent - 25);
  return (bits & 0x8000) != 0 ? -size : size;
}

/// Numbers as NumPy stores them.
class Elements {
 public:
  Elements(const std::string& name, const std::string& type, const std::uint8_t* data) : data_(data) {
    const std::string kind = type.size() == 3 ? type.substr(1) : "";
    static constexpr std::array<const char*, 7> kKinds{"f2", "f4", "f8", "u2", "u4", "i2", "i4"};
    const bool known = std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end() || kind == "u8" || kind == "i8";
    check(known && (type[0] == '<' || type[0] == '>'), name, ": holds numbers of the NumPy type '", printable(type),
          "', expected depth as float16, float32, float64 or integers of 16 to 64 bits",
          kind == "u1" || kind == "i1" ? "; 8 bits are too few for depth" : "");
    swapped_ = type[0] == '>';
    letter_ = kind[0];
    width_ = static_cast<std::size_t>(kind[1] - '0');
  }

  bool are_integers() const { return letter_ != 'f'; }
  std::size_t width() const { return width_; }

  /// The element, or 0 for the largest level of 16 bits, which cameras write for pixels that were not measured.
  double at(std::size_t index) const {
    std::array<std::uint8_t, 8> bytes{};
    std::copy_n(data_ + index * width_, width_, bytes.begin());
    if (swapped_) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(width_));
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes.data(), sizeof bits);
    switch (letter_) {
      case 'f':
        if (width_ == 2) return half_value(static_cast<std::uint16_t>(bits));
        if (width_ == 4) return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        return std::bit_cast<double>(bits);
      case 'u':
        return width_ == 2 && bits == 0xffff ? 0 : static_cast<double>(bits);
      default: {  // 'i': with the sign of its width
        const int shift = 64 - 8 * static_cast<int>(width_);
        return static_cast<double>(static_cast<std::int64_t>(bits << shift) >> shift);
      }
    }
  }

 private:
  const std::uint8_t* data_;
  bool swapped_;
  char letter_;
  std::size_t width_;
};

}  // namespace

bool is_npy(Bytes file) { return has_bytes(file, 0, "\x93NUMPY"); }

DepthImage decode_npy_depth(const std::string& name, Bytes file, std::optional<double> unit_m) {
  const Header header = header_of(name, file);
  const Elements elements(name, header.type, file.data() + header.size);
  std::vector<Index> shape = header.shape;
  while (shape.size() > 2 && shape.back() == 1) shape.pop_back();
  while (shape.size() > 2 && shape.front() == 1) shape.erase(shape.begin());
  check(shape.size() == 2, name, ": holds an array that is not two-dimensional, expected (height, width)");
  DepthImage image{shape[0], shape[1], {}};
  check_image_size(name, image.height, image.width);
  const auto rows = static_cast<std::size_t>(image.height), columns = static_cast<std::size_t>(image.width);
  if ((file.size() - header.size) / elements.width() != rows * columns ||
      (file.size() - header.size) % elements.width() != 0)
    fail_damaged_npy(name, "its size is not that of its array");
  const double scale = image.unit_m = unit_m.value_or(elements.are_integers() ? 0.001 : 1.0);
  image.metres.reserve(rows * columns);
  double nearest_m = INFINITY;
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x) {
      const double z = scale * elements.at(header.by_columns ? x * rows + y : y * columns + x);
      image.metres.push_back(depth_or_zero(z));
      if (z > 0 && z < nearest_m) nearest_m = z;
    }
  check(nearest_m < kFarthest_m || std::isinf(nearest_m), name, ": its smallest distance is ", nearest_m,
        " m; is it in another unit? Millimetres are --depth-unit ", depth_unit_name(0.001 * scale));
  return image;
}

}  // namespace svnet::io
