#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "mesh_readers.h"
#include "mesh_textures.h"
#include "ply_file.h"
#include "simulation/texture.h"

namespace svnet::simulation {
namespace {

/// Where the colours of an element stand; all are sRGB. Floats are in [0, 1], or in [0, 255] if one is above 1.
/// Integers fill the range of their type, or only [0, 255] if none is above that.
struct Colours {
  std::array<int, 3> at{-1, -1, -1};
  std::array<double, 3> most{1, 1, 1};
  double highest = 0;  // of the colours that look_at has seen

  explicit Colours(const PlyElement& element)
      : at{element.find({"red", "r", "diffuse_red"}), element.find({"green", "g", "diffuse_green"}),
           element.find({"blue", "b", "diffuse_blue"})} {
    if (!are_there()) return;
    for (std::size_t c = 0; c < 3; ++c) {
      const PlyType& type = element.properties[static_cast<std::size_t>(at[c])].type;
      if (!type.is_float) most[c] = std::exp2(8.0 * static_cast<double>(type.bytes)) - 1;
    }
  }

  bool are_there() const {
    return std::none_of(at.begin(), at.end(), [](int i) { return i < 0; });
  }

  /// Chooses the range. All rows of the element must be seen before `of`.
  void look_at(const PlyRow& row) {
    for (const int property : at)
      if (const auto& value = row[static_cast<std::size_t>(property)]; !value.empty())
        highest = std::max(highest, value[0]);
  }

  double white(std::size_t channel) const {
    const bool are_levels = most[channel] == 1 ? highest > 1 : highest <= 255;
    return are_levels ? 255 : most[channel];
  }

  Vec3 of(const PlyRow& row) const {
    Vec3 colour;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::vector<double>& value = row[static_cast<std::size_t>(at[c])];
      const double share = value.empty() || !(value[0] > 0) ? 0.0 : std::min(value[0] / white(c), 1.0);
      colour[static_cast<Eigen::Index>(c)] = linear_from_srgb(static_cast<std::uint8_t>(std::lround(255 * share)));
    }
    return colour;
  }
};

class PlyReader {
 public:
  PlyReader(const PlyHeader& header, const PlyBody& body, const MeshFiles& files, MeshDraft& draft)
      : header_(header), body_(body), textures_(files, draft), draft_(draft) {}

  void read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      if (element.name == "vertex")
        read_vertices(element);
      else if (element.name == "face")
        read_faces(element);
      else if (element.name == "tristrips")
        read_strips(element);
      else
        for_rows(element, [](const PlyRow&) {});
    }
  }

 private:
  /// The colours of an element whose rows come next.
  Colours colours_of(const PlyElement& element) {
    Colours colours(element);
    if (!colours.are_there()) return colours;
    const PlyBody before = body_;
    PlyRow row;
    for (std::uint64_t i = 0; i < element.count && body_.take(element, row); ++i) colours.look_at(row);
    body_ = before;
    return colours;
  }

  template <class Body>
  void for_rows(const PlyElement& element, Body body) {
    PlyRow row;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!body_.take(element, row))
        fail(draft_.name(), ": holds ", i, " of ", element.count, " elements '", printable(element.name),
             "'; is the file incomplete?");
      body(row);
    }
  }

  void read_vertices(const PlyElement& element) {
    check(draft_.points.empty(), draft_.name(), ": has vertices in two places of its header, expected one");
    std::array<std::size_t, 3> at{};
    for (std::size_t c = 0; c < 3; ++c) {
      const int found = element.find({std::string_view("xyz").substr(c, 1)});
      check(found >= 0, draft_.name(), ": its vertices have no '", "xyz"[c], "'");
      at[c] = static_cast<std::size_t>(found);
    }
    const Colours colours = colours_of(element);
    const int u = element.find({"s", "u", "texture_u", "texture_s"}),
              v = element.find({"t", "v", "texture_v", "texture_t"});
    const bool has_uv = u >= 0 && v >= 0 && !header_.textures.empty();
    for_rows(element, [&](const PlyRow& row) {
      const auto number = [&](std::size_t i) { return row[i].empty() ? 0.0 : row[i][0]; };
      draft_.points.emplace_back(number(at[0]), number(at[1]), number(at[2]));
      if (colours.are_there()) tints_.push_back(colours.of(row));
      if (has_uv)
        uv_.emplace_back(static_cast<float>(number(static_cast<std::size_t>(u))),
                         static_cast<float>(number(static_cast<std::size_t>(v))));
    });
  }

  /// The material of a texture of the header, or without one.
  int material_of(std::size_t texture) {
    const int key = texture < header_.textures.size() ? static_cast<int>(texture) : -1;
    if (const auto known = materials_.find(key); known != materials_.end()) return known->second;
    Material material;
    std::optional<int> image;
    if (texture < header_.textures.size()) image = textures_.file(header_.textures[texture]);
    material.colour = material.second = image || has_colours_ ? Vec3(Vec3::Ones()) : kNoColour;
    if (image) material.texture = Texture::image, material.image = *image;
    return materials_[key] = draft_.add(material);
  }

  std::uint32_t corner(double index) const {
    check(index >= 0 && index < static_cast<double>(draft_.points.size()), draft_.name(),
          ": a face has a corner at point ", index, " of ", draft_.points.size());
    return static_cast<std::uint32_t>(index);
  }

  void read_faces(const PlyElement& element) {
    constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    const int corners = element.find({"vertex_indices", "vertex_index"}), wedges = element.find({"texcoord"}),
              texture = element.find({"texnumber"});
    check(corners >= 0, draft_.name(), ": its faces have no 'vertex_indices'");
    const Colours colours = colours_of(element);
    has_colours_ = colours.are_there() || !tints_.empty();
    std::vector<std::uint32_t> face;
    std::vector<Eigen::Vector3d> polygon;
    for_rows(element, [&](const PlyRow& row) {
      face.clear(), polygon.clear();
      for (const double index : row[static_cast<std::size_t>(corners)]) {
        face.push_back(corner(index));
        polygon.push_back(draft_.points[face.back()]);
      }
      check(!face.empty(), draft_.name(), ": a face has no corners; is the file incomplete?");
      if (face.size() < 3) return;
      const std::vector<double>* places = wedges < 0 ? nullptr : &row[static_cast<std::size_t>(wedges)];
      const bool has_wedges = places != nullptr && places->size() >= 2 * face.size();
      std::size_t image = has_wedges || !uv_.empty() ? 0 : kNone;
      if (image == 0 && texture >= 0 && !row[static_cast<std::size_t>(texture)].empty()) {
        const double number = row[static_cast<std::size_t>(texture)][0];
        image = number >= 0 && number < 1e6 ? static_cast<std::size_t>(number) : kNone;
      }
      const int material = material_of(image);
      const Vec3 tint = colours.are_there() ? colours.of(row) : Vec3(Vec3::Ones());
      for (const auto& triangle : polygon_triangles(polygon)) {
        draft_.add_triangle({face[triangle[0]], face[triangle[1]], face[triangle[2]]}, material);
        std::array<Vec2, 3> uv;
        std::array<Vec3, 3> tints;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t local = triangle[k], point = face[local];
          if (has_wedges)
            uv[k] = Vec2(static_cast<float>((*places)[2 * local]), static_cast<float>((*places)[2 * local + 1]));
          else if (image != kNone)
            uv[k] = uv_[point];
          tints[k] = tints_.empty() ? tint : Vec3(tint.cwiseProduct(tints_[point]));
        }
        dress(material, image != kNone, uv, tints);
      }
    });
  }

  /// A texture counts alone: the colours beside it are those of the points before it was made.
  void dress(int material, bool has_uv, const std::array<Vec2, 3>& uv, const std::array<Vec3, 3>& tints) {
    const bool has_image = draft_.material(material).texture == Texture::image;
    if (has_image && has_uv) draft_.set_uv(uv);
    if (!has_image && has_colours_) draft_.set_tints(tints);
  }

  /// Strips one after the other with -1 between them; every second triangle is turned.
  void read_strips(const PlyElement& element) {
    const int corners = element.find({"vertex_indices", "vertex_index"});
    check(corners >= 0, draft_.name(), ": its strips have no 'vertex_indices'");
    has_colours_ = !tints_.empty();
    const int material = material_of(static_cast<std::size_t>(-1));
    for_rows(element, [&](const PlyRow& row) {
      std::vector<std::uint32_t> strip;
      for (const double index : row[static_cast<std::size_t>(corners)]) {
        if (index < 0) {
          strip.clear();
          continue;
        }
        strip.push_back(corner(index));
        const std::size_t n = strip.size();
        if (n < 3) continue;
        std::array<std::uint32_t, 3> triangle{strip[n - 3], strip[n - 2], strip[n - 1]};
        if (n % 2 == 0) std::swap(triangle[0], triangle[1]);
        draft_.add_triangle(triangle, material);
        if (!tints_.empty()) draft_.set_tints({tints_[triangle[0]], tints_[triangle[1]], tints_[triangle[2]]});
      }
    });
  }

  const PlyHeader& header_;
  PlyBody body_;
  MeshTextures textures_;
  MeshDraft& draft_;
  std::vector<Vec3> tints_;  // per point, or empty
  std::vector<Vec2> uv_;     // per point, or empty
  bool has_colours_ = false;
  std::map<int, int> materials_;
};

}  // namespace

void read_ply(std::string_view file, const MeshFiles& files, MeshDraft& draft) {
  const PlyHeader header = take_ply_header(draft.name(), file);
  PlyReader(header, PlyBody(header.format, file), files, draft).read();
}

}  // namespace svnet::simulation
