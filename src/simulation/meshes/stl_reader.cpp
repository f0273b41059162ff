// STL: facets of three corners each, as words or packed: 80 bytes of header, a 32-bit count, and per facet a normal,
// three corners (12 floats) and 16 bits that some programs use for a colour.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <unordered_map>

#include "base/error.h"
#include "mesh_readers.h"
#include "simulation/texture.h"
#include "text_words.h"

namespace svnet::simulation {
namespace {

constexpr std::size_t kHeader = 80, kFacet = 50;
static_assert(std::endian::native == std::endian::little, "packed STL is read as it lies in memory");

template <class Number>
Number packed(std::string_view file, std::size_t at) {
  Number number;
  std::memcpy(&number, file.data() + at, sizeof number);
  return number;
}

/// Colours of facets. VisCAM: bit 15 marks a colour, red in the upper bits. Magics, whose header has COLOR= and four
/// bytes: bit 15 means the object's colour, otherwise red is in the lower bits.
class FacetColours {
 public:
  explicit FacetColours(std::string_view file) : file_(file) {
    const std::string_view header = file.substr(0, kHeader);
    if (const std::size_t at = header.find("COLOR="); at < kHeader - 9) {
      is_magics_ = true;
      for (std::size_t c = 0; c < 3; ++c)
        object_[static_cast<Eigen::Index>(c)] = linear_from_srgb(static_cast<std::uint8_t>(header[at + 6 + c]));
    }
  }

  /// Whether any facet says anything; attributes that are 0 throughout are those of programs that know no colours.
  void look_at(std::size_t count) {
    for (std::size_t i = 0; i < count && !any_; ++i) any_ = attribute(i) != 0;
  }

  Vec3 of(std::size_t facet) const {
    const std::uint16_t bits = attribute(facet);
    const bool has_own = any_ && is_magics_ == ((bits & 0x8000) == 0);
    if (!has_own) return is_magics_ ? object_ : kNoColour;
    const auto level = [&](int shift) {
      return linear_from_srgb(static_cast<std::uint8_t>(((bits >> shift & 31) * 255 + 15) / 31));
    };
    return is_magics_ ? Vec3(level(0), level(5), level(10)) : Vec3(level(10), level(5), level(0));
  }

 private:
  std::uint16_t attribute(std::size_t facet) const {
    return packed<std::uint16_t>(file_, kHeader + 4 + kFacet * facet + 48);
  }

  std::string_view file_;
  bool is_magics_ = false, any_ = false;
  Vec3 object_ = kNoColour;
};

/// Gives corners at the same place, which every facet of the format repeats, one point.
class Welder {
 public:
  explicit Welder(MeshDraft& draft) : draft_(draft) {}

  std::uint32_t point(const Eigen::Vector3d& at) {
    const auto [known, is_new] =
        known_.try_emplace({at.x(), at.y(), at.z()}, static_cast<std::uint32_t>(draft_.points.size()));
    if (is_new) draft_.points.push_back(at);
    return known->second;
  }

 private:
  using Key = std::array<double, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t sum = 0;
      for (const double value : key)
        sum = (sum ^ std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value)) * 0x9e3779b97f4a7c15u, sum ^= sum >> 29;
      return sum;
    }
  };

  MeshDraft& draft_;
  std::unordered_map<Key, std::uint32_t, Hash> known_;
};

void read_packed(std::string_view file, MeshDraft& draft) {
  check(file.size() >= kHeader + 4, draft.name(), ": is neither a text nor a packed STL file; it has ", file.size(),
        " bytes");
  const auto count = std::size_t{packed<std::uint32_t>(file, kHeader)};
  const std::size_t held = (file.size() - kHeader - 4) / kFacet;
  check(count <= held, draft.name(), ": promises ", count, " triangles and holds ", held, "; is the file incomplete?");
  FacetColours colours(file);
  colours.look_at(count);
  Material material;
  material.colour = material.second = Vec3::Ones();
  const int number = draft.add(material);
  Welder welder(draft);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<std::uint32_t, 3> corner{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t at = kHeader + 4 + kFacet * i + 12 * (k + 1);
      corner[k] = welder.point(
          Eigen::Vector3f(packed<float>(file, at), packed<float>(file, at + 4), packed<float>(file, at + 8))
              .cast<double>());
    }
    draft.add_triangle(corner, number);
    const Vec3 colour = colours.of(i);
    draft.set_tints({colour, colour, colour});
  }
}

void read_text(std::string_view file, const MeshFiles& files, MeshDraft& draft) {
  Material material;
  material.colour = material.second = kNoColour;
  const int number = draft.add(material);
  Welder welder(draft);
  std::vector<Eigen::Vector3d> loop;
  bool in_loop = false, has_end = false;
  for (std::size_t line_number = 1; !file.empty(); ++line_number) {
    std::string_view line = take_line(file);
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const std::string key = lower_case(word);
      if (key == "solid" || key == "endsolid") {
        has_end = key == "endsolid";
        break;  // a name follows
      }
      if (key == "loop") {
        loop.clear();
        in_loop = true;
      } else if (key == "vertex") {
        Eigen::Vector3d point;
        for (int c = 0; c < 3; ++c) {
          const std::string_view number_word = take_word(line);
          check(parse_signed(number_word, point[c]), draft.name(), ": line ", line_number, ": '",
                printable(number_word), "' is not a coordinate");
        }
        loop.push_back(point);
      } else if (key == "endloop") {
        in_loop = false;
        check(loop.size() >= 3, draft.name(), ": line ", line_number, ": a facet has ", loop.size(), " corners");
        for (const auto& [a, b, c] : polygon_triangles(loop))
          draft.add_triangle({welder.point(loop[a]), welder.point(loop[b]), welder.point(loop[c])}, number);
      }
    }
  }
  check(!in_loop, draft.name(), ": ends inside a facet; is the file incomplete?");
  if (!has_end) files.warn("has no 'endsolid' at its end; is the file incomplete?");
}

}  // namespace

void read_stl(std::string_view file, const MeshFiles& files, MeshDraft& draft) {
  // Packed files may begin with "solid" as well: the length tells.
  const bool fits = file.size() >= kHeader + 4 &&
                    file.size() == kHeader + 4 + kFacet * std::size_t{packed<std::uint32_t>(file, kHeader)};
  const std::string start = lower_case(trimmed(file.substr(0, std::min<std::size_t>(file.size(), 512))).substr(0, 5));
  const bool looks_like_text = start == "solid" && file.substr(0, 512).find('\0') == std::string_view::npos;
  if (!fits && looks_like_text)
    read_text(file, files, draft);
  else
    read_packed(file, draft);
}

}  // namespace svnet::simulation
