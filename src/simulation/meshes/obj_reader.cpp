// Wavefront OBJ: lines of a keyword and its arguments; indices begin at 1, negative ones count from the end.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "mesh_readers.h"
#include "mesh_textures.h"
#include "mtl_file.h"
#include "simulation/texture.h"
#include "text_words.h"

namespace svnet::simulation {
namespace {

class ObjReader {
 public:
  ObjReader(const MeshFiles& files, MeshDraft& draft) : files_(files), textures_(files, draft), draft_(draft) {}

  void read(std::string_view file) {
    file = without_byte_order_mark(file);
    rest_ = file;
    while (!file.empty()) {
      ++line_number_;
      std::string_view line = take_line(file);
      if (trimmed(line).ends_with('\\')) {  // goes on in the next line
        joined_ = std::string(trimmed(line));
        while (trimmed(joined_).ends_with('\\') && !file.empty()) {
          joined_.pop_back();
          joined_ += ' ' + std::string(trimmed(take_line(file)));
          ++line_number_;
        }
        line = joined_;
      }
      rest_ = file;
      read_line(line);
    }
    if (!missing_.empty() && missing_files_.empty())
      files_.warn(joined("material '", printable(missing_), "' is in no material file; its faces are grey"));
  }

 private:
  template <class... Parts>
  void check_line(bool condition, const Parts&... parts) const {
    if (!condition) fail(draft_.name(), ": line ", line_number_, ": ", parts...);
  }

  void read_line(std::string_view line) {
    const std::string_view key = take_word(line);
    if (key == "v") return read_point(line);
    if (key == "vt") {
      const double u = number(line), v = trimmed(line).empty() ? 0.0 : number(line);
      uv_.emplace_back(static_cast<float>(u), static_cast<float>(v));
    } else if (key == "f" || key == "fo") {
      read_face(line);
    } else if (key == "usemtl") {
      material_name_ = std::string(trimmed(line));
      material_ = nullptr;
    } else if (key == "mtllib") {
      read_materials(trimmed(line));
    }
  }

  double number(std::string_view& line) {
    const std::string_view word = take_word(line);
    double value = 0;
    check_line(parse_signed(word, value), "'", printable(word), "' is not a number");
    return value;
  }

  /// What follows the coordinates of a point: nothing, w, or r g b.
  static std::vector<double> after_coordinates(std::string_view line) {
    std::vector<double> numbers;
    double number = 0;
    while (numbers.size() < 3 && parse_signed(take_word(line), number)) numbers.push_back(number);
    return numbers;
  }

  /// The level of white: 1, or 255 if a colour of this line or a later one is above 1, as some programs write levels.
  double white_from(std::string_view line) const {
    for (std::string_view file = rest_;; line = take_line(file)) {
      std::string_view words = line;
      if (take_word(words) == "v") {
        for (int c = 0; c < 3; ++c) take_word(words);
        const std::vector<double> colour = after_coordinates(words);
        if (colour.size() == 3 && *std::max_element(colour.begin(), colour.end()) > 1) return 255;
      }
      if (file.empty()) return 1;
    }
  }

  /// "x y z [w]", or "x y z r g b" as scanners write it.
  void read_point(std::string_view line) {
    const std::string_view words = line;
    const double x = number(line), y = number(line), z = number(line);
    draft_.points.emplace_back(x, y, z);
    const std::vector<double> more = after_coordinates(line);
    if (more.size() < 3) return;
    if (white_ == 0) white_ = white_from("v " + std::string(words));
    Vec3 colour;
    for (std::size_t c = 0; c < 3; ++c) {
      const double level = 255 / white_ * more[c];
      colour[static_cast<Eigen::Index>(c)] =
          linear_from_srgb(static_cast<std::uint8_t>(level > 0 ? std::lround(std::min(level, 255.0)) : 0));
    }
    tints_.resize(draft_.points.size() - 1, kNoColour);
    tints_.push_back(colour);
  }

  std::uint32_t index(std::string_view text, std::size_t count, const char* what) const {
    std::int64_t number = 0;
    check_line(parse_number(text, number) && number != 0, "'", printable(text), "' is not the number of a ", what);
    if (number < 0) number += static_cast<std::int64_t>(count) + 1;
    check_line(number > 0 && number <= static_cast<std::int64_t>(count), "a corner is at ", what, " ", text, " of ",
               count);
    return static_cast<std::uint32_t>(number - 1);
  }

  void read_face(std::string_view line) {
    face_.clear(), places_.clear(), polygon_.clear();
    for (std::string_view word = take_word(line); !word.empty() && word[0] != '#'; word = take_word(line)) {
      const std::size_t slash = word.find('/');
      face_.push_back(index(word.substr(0, slash), draft_.points.size(), "point"));
      polygon_.push_back(draft_.points[face_.back()]);
      if (slash == std::string_view::npos) continue;
      word.remove_prefix(slash + 1);
      if (const std::string_view place = word.substr(0, word.find('/')); !place.empty())
        places_.push_back(uv_[index(place, uv_.size(), "texture coordinate")]);
    }
    if (face_.size() < 3) {  // a point or a line
      check_line(!face_.empty(), "a face has no corners; is the file incomplete?");
      return;
    }
    if (material_ == nullptr) material_ = &used_material();
    const bool has_places = places_.size() == face_.size();
    const bool has_image = material_->has_texture && has_places;
    const int number = has_image ? material_->textured : material_->plain;
    for (const auto& triangle : polygon_triangles(polygon_)) {
      std::array<std::uint32_t, 3> corner{};
      std::array<Vec2, 3> uv, metal_uv;
      for (std::size_t k = 0; k < 3; ++k) {
        corner[k] = face_[triangle[k]];
        if (!has_places) continue;
        uv[k] = moved(material_->from.diffuse_map, places_[triangle[k]]);
        metal_uv[k] = moved(material_->from.metal_map, places_[triangle[k]]);
      }
      draft_.add_triangle(corner, number);
      if (has_image) {
        draft_.set_uv(uv);
      } else if (!tints_.empty()) {
        tints_.resize(draft_.points.size(), kNoColour);
        draft_.set_tints({tints_[corner[0]], tints_[corner[1]], tints_[corner[2]]});
      }
      if (has_places && draft_.material(number).metal_image >= 0) draft_.set_metal_uv(metal_uv);
    }
  }

  static Vec2 moved(const std::optional<MtlMap>& map, const Vec2& place) {
    if (!map) return place;
    return {place.x() * map->scale[0] + map->offset[0], place.y() * map->scale[1] + map->offset[1]};
  }

  /// The names of one or more files, which may themselves hold blanks.
  void read_materials(std::string_view names) {
    if (read_material_file(std::string(names))) return;
    std::vector<std::string> words;
    for (std::string_view rest = names; !trimmed(rest).empty();) words.emplace_back(take_word(rest));
    bool is_missing = words.size() < 2;
    if (words.size() > 1)
      for (const std::string& word : words) is_missing |= !read_material_file(word);
    if (!is_missing || !missing_files_.insert(std::string(names)).second) return;
    files_.warn(joined("material file '", printable(names), "' is missing; the object is rendered without it"));
  }

  bool read_material_file(const std::string& name) {
    const auto path = files_.find("material file", name);
    if (!path) return false;
    for (MtlMaterial& material : parse_mtl(files_.contents(*path)))
      materials_.try_emplace(material.name, UsedMaterial{material, -1, -1, false});
    return true;
  }

  struct UsedMaterial {
    MtlMaterial from;
    int plain,
        textured;  // indices in the draft: of faces without and with texture coordinates; -1 before the first use
    bool has_texture;
  };

  /// The material in use, added to the draft.
  UsedMaterial& used_material() {
    const auto [place, is_unknown] = materials_.try_emplace(material_name_, UsedMaterial{{}, -1, -1, false});
    UsedMaterial& used = place->second;
    if (is_unknown && missing_.empty()) missing_ = material_name_;
    if (used.plain >= 0) return used;
    Material material;
    const bool has_tints = !tints_.empty();
    material.colour = material.second = has_tints ? Vec3(Vec3::Ones()) : used.from.diffuse.value_or(kNoColour);
    material.metal = used.from.metal > 0.5f;
    if (const auto& map = used.from.metal_map) {
      if (const auto image = textures_.file(map->file)) {
        material.metal_image = *image;
        material.metal_factor = used.from.metal > 0 ? used.from.metal : 1;
      }
    }
    used.plain = used.textured = draft_.add(material);
    if (const auto& map = used.from.diffuse_map) {
      if (const auto image = textures_.file(map->file)) {
        material.texture = Texture::image;
        material.image = *image;
        material.colour = material.second = texture_factor(used.from);
        if (map->clamp) material.wrap = {Wrap::clamp, Wrap::clamp};
        used.textured = draft_.add(material);
        used.has_texture = true;
      }
    }
    return used;
  }

  const MeshFiles& files_;
  MeshTextures textures_;
  MeshDraft& draft_;
  std::size_t line_number_ = 0;
  std::string joined_;
  std::vector<Vec2> uv_;
  std::string_view rest_;    // of the file, after the line that is being read
  double white_ = 0;         // of colours of points; 0 before the first one
  std::vector<Vec3> tints_;  // of the points up to the last one that has a colour, or empty
  std::map<std::string, UsedMaterial> materials_;
  std::string material_name_, missing_;
  std::set<std::string> missing_files_;
  UsedMaterial* material_ = nullptr;
  std::vector<std::uint32_t> face_;
  std::vector<Vec2> places_;
  std::vector<Eigen::Vector3d> polygon_;
};

}  // namespace

void read_obj(std::string_view file, const MeshFiles& files, MeshDraft& draft) { ObjReader(files, draft).read(file); }

}  // namespace svnet::simulation
