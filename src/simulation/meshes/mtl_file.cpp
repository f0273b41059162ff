#include "mtl_file.h"

#include "text_words.h"

namespace svnet::simulation {
namespace {

/// The numbers at the front of a line, at most three.
std::vector<float> take_numbers(std::string_view& line) {
  std::vector<float> numbers;
  for (std::string_view rest = line; numbers.size() < 3;) {
    float number = 0;
    if (!parse_signed(take_word(rest), number)) break;
    numbers.push_back(number);
    line = rest;
  }
  return numbers;
}

/// "[-option values…]… file name": the name may hold blanks, and quotes around it.
MtlMap map_of(std::string_view line) {
  MtlMap map;
  for (;;) {
    std::string_view rest = line;
    const std::string option = lower_case(take_word(rest));
    const bool has_numbers = option == "-s" || option == "-o" || option == "-t" || option == "-mm";
    const bool has_word = option == "-blendu" || option == "-blendv" || option == "-clamp" || option == "-cc" ||
                          option == "-bm" || option == "-boost" || option == "-texres" || option == "-imfchan" ||
                          option == "-type";
    if (!has_numbers && !has_word) break;
    if (has_numbers) {
      const std::vector<float> numbers = take_numbers(rest);
      if (option == "-s" || option == "-o")
        for (std::size_t i = 0; i < numbers.size() && i < 2; ++i)
          (option == "-s" ? map.scale : map.offset)[i] = numbers[i];
    } else {
      const std::string_view word = take_word(rest);
      if (option == "-clamp") map.clamp = lower_case(word) == "on";
    }
    line = rest;
  }
  line = trimmed(line);
  if (line.size() > 1 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
  map.file = std::string(line);
  return map;
}

std::optional<Vec3> colour_of(std::string_view line) {
  const std::vector<float> numbers = take_numbers(line);
  if (numbers.empty()) return std::nullopt;  // spectral, xyz
  Vec3 colour;
  for (int c = 0; c < 3; ++c) {
    const float value = numbers[std::min(static_cast<std::size_t>(c), numbers.size() - 1)];
    colour[c] = value > 0 ? std::min(value, 1.0f) : 0.0f;
  }
  return colour;
}

}  // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view file) {
  std::vector<MtlMaterial> materials;
  file = without_byte_order_mark(file);
  while (!file.empty()) {
    std::string_view line = take_line(file);
    const std::string key = lower_case(take_word(line));
    if (key == "newmtl") materials.push_back({std::string(trimmed(line)), {}, 0, {}, {}});
    if (materials.empty()) continue;
    MtlMaterial& material = materials.back();
    if (key == "kd") material.diffuse = colour_of(line);
    if (key == "map_kd") material.diffuse_map = map_of(line);
    if (key == "map_pm") material.metal_map = map_of(line);
    if (const std::vector<float> numbers = key == "pm" ? take_numbers(line) : std::vector<float>(); !numbers.empty())
      material.metal = numbers[0];
  }
  std::erase_if(materials, [](const MtlMaterial& material) { return material.name.empty(); });
  for (MtlMaterial& material : materials)
    for (auto* map : {&material.diffuse_map, &material.metal_map})
      if (*map && (*map)->file.empty()) map->reset();
  return materials;
}

Vec3 texture_factor(const MtlMaterial& material) {
  return material.diffuse && *material.diffuse != Vec3::Zero() ? *material.diffuse : Vec3(Vec3::Ones());
}

}  // namespace svnet::simulation
