#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "image/image.h"

namespace svnet::simulation {

using Vec2 = Eigen::Vector2f;
using Vec3 = Eigen::Vector3f;

/// What modulates a material's colour; `scale_m` is the size of its details.
enum class Texture { plain, wood, brushed, speckled, stripes, checks, image };

/// What an image shows beyond [0, 1].
enum class Wrap { repeat, mirror, clamp };

/// How a surface looks. Colours are linear RGB in [0, 1].
struct Material {
  Vec3 colour{0.5f, 0.5f, 0.5f};
  Vec3 second{0.3f, 0.3f, 0.3f};  // the texture's other colour
  Texture texture = Texture::plain;
  float scale_m = 0.01f;
  float gloss = 0.04f;   // reflectance when seen from straight above
  float sharpness = 40;  // exponent of the highlight
  bool metal = false;    // reflects in its own colour and scatters little
  float clear = 0;       // share of light that passes, [0, 1)
  int image = -1;        // index into Mesh::images; multiplies `colour` if texture is `image`
  std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};  // of the image, along u and v
  // The share of metal per point: metal_factor times the blue channel of this image; `metal` counts if it is -1.
  int metal_image = -1;
  float metal_factor = 1;
};

/// Triangles with materials, in metres. Shapes may overlap: their union is what is seen.
struct Mesh {
  struct Triangle {
    std::array<std::uint32_t, 3> corner;
    int material;
  };
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::array<Vec3, 3>> normals;   // per corner of each triangle; shade_smoothly fills them
  std::vector<std::array<Vec2, 3>> uv;        // as normals, or empty if no texture is an image
  std::vector<std::array<Vec2, 3>> metal_uv;  // as uv, of the metal images
  std::vector<std::array<Vec3, 3>> tints;     // as normals, or empty: linear colours that multiply the material's
  std::vector<Material> materials;
  std::vector<Image> images;
};

/// Normals per corner: the mean of those of the triangles around the point, weighted by area, that turn from this one
/// by less than `crease_deg`.
void shade_smoothly(Mesh&, float crease_deg = 40);

/// The centre of mass of a solid of even density, overlaps counted twice; of its surface if the mesh encloses no
/// volume.
Eigen::Vector3d centre_of_mass(const Mesh&);

}  // namespace svnet::simulation
