#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "simulation/mesh.h"

namespace svnet::simulation {

/// An image that a material names, and the options before its name.
struct MtlMap {
  std::string file;
  std::array<float, 2> scale{1, 1}, offset{0, 0};
  bool clamp = false;
};

/// What is read of a material; linear colours.
struct MtlMaterial {
  std::string name;
  std::optional<Vec3> diffuse;  // Kd
  float metal = 0;              // Pm
  std::optional<MtlMap> diffuse_map, metal_map;
};

/// The materials of an MTL file, in order. Keywords count in any case; lines that are not understood are ignored.
std::vector<MtlMaterial> parse_mtl(std::string_view file);

/// Kd × map_Kd. Kd 0 0 0, which many programs write beside a texture, leaves the texture alone.
Vec3 texture_factor(const MtlMaterial&);

}  // namespace svnet::simulation
