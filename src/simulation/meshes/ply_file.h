#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// PLY files without their meaning: a header of lines that declares elements and their properties, then the elements one
// after the other, as lines of numbers or packed. Lists carry their length before them.
namespace svnet::simulation {

struct PlyType {
  std::size_t bytes = 0;  // 0: no type
  bool is_float = false, is_signed = false;
};

/// A number, or a list of them if `length` is a type.
struct PlyProperty {
  std::string name;
  PlyType type, length;
};

struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;

  /// The index of the property of any of these names, or -1.
  int find(std::initializer_list<std::string_view> names) const;
};

struct PlyHeader {
  enum class Format { text, little_endian, big_endian } format = Format::text;
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;  // of "comment TextureFile NAME", as MeshLab writes them
};

/// Takes the header from the front of `file`. Throws Error that begins with `name` if it is not complete, or
/// promises more elements than bytes follow.
PlyHeader take_ply_header(const std::string& name, std::string_view& file);

/// The values of one element: of each property in order, one or as many as its list has.
using PlyRow = std::vector<std::vector<double>>;

/// Takes elements from the front of the body.
class PlyBody {
 public:
  PlyBody(PlyHeader::Format format, std::string_view body) : format_(format), rest_(body) {}

  /// False if the element is not all there.
  bool take(const PlyElement& element, PlyRow& row);

 private:
  bool take_text(const PlyElement& element, PlyRow& row);
  double take_number(const PlyType& type);

  PlyHeader::Format format_;
  std::string_view rest_;
};

}  // namespace svnet::simulation
