#pragma once
#include <span>

#include "simulation/mesh.h"

namespace svnet::simulation {

/// The colour of a material at a point of the object's own frame, in metres. `uv` and `images` matter if the
/// texture is an image, which multiplies the material's colour; v = 0 is its lowest row.
Vec3 surface_colour(const Material&, const Vec3& local_m, const Vec2& uv, const std::vector<Image>& images);

/// Whether the surface is metal at `uv`: at least half of it, by the material's metal image.
bool is_metal(const Material&, const Vec2& uv, const std::vector<Image>& images);

/// 8-bit sRGB to linear and back.
float linear_from_srgb(std::uint8_t level);
float srgb_from_linear(float value);  // in [0, 255], clipped
/// Its table: element i is the level of (i / n)², where n is the size less 2.
std::span<const float> srgb_table();

}  // namespace svnet::simulation
