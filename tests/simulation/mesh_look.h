#pragma once
#include <vector>

#include "simulation/mesh.h"
#include "simulation/texture.h"

/// What a mesh looks like without light: means over its surface.
struct MeshLook {
  svnet::simulation::Vec3 srgb = svnet::simulation::Vec3::Zero();  // of the sRGB levels, [0, 255]
  float metal = 0;                                                 // share of the surface
};

inline MeshLook look_of(const svnet::simulation::Mesh& mesh) {
  using namespace svnet;
  using namespace svnet::simulation;
  constexpr int kSteps = 8;  // along each side of a triangle
  MeshLook look;
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const Material& material = mesh.materials[static_cast<std::size_t>(triangle.material)];
    const Vec3 a = mesh.points[triangle.corner[0]], b = mesh.points[triangle.corner[1]],
               c = mesh.points[triangle.corner[2]];
    const float weight = (b - a).cross(c - a).norm() / (kSteps * kSteps);
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        // The lower and, mirrored, the upper half of each cell of the parallelogram.
        float u = (static_cast<float>(i) + 0.4f) / kSteps, v = (static_cast<float>(j) + 0.3f) / kSteps;
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const auto between = [&](const auto& corner) {
          return ((1 - u - v) * corner[0] + u * corner[1] + v * corner[2]).eval();
        };
        const Vec2 uv = mesh.uv.empty() ? Vec2(0, 0) : between(mesh.uv[t]);
        Vec3 colour = surface_colour(material, Vec3::Zero(), uv, mesh.images);
        if (!mesh.tints.empty()) colour = colour.cwiseProduct(between(mesh.tints[t]));
        for (int k = 0; k < 3; ++k) look.srgb[k] += weight * srgb_from_linear(colour[k]);
        const Vec2 metal_uv = mesh.metal_uv.empty() ? Vec2(0, 0) : between(mesh.metal_uv[t]);
        if (is_metal(material, metal_uv, mesh.images)) look.metal += weight;
        area += static_cast<double>(weight);
      }
  }
  look.srgb /= static_cast<float>(area);
  look.metal /= static_cast<float>(area);
  return look;
}
