#pragma once
#include <cstddef>
#include <cstdint>

#include "simulation/mesh.h"

namespace svnet::simulation {

/// Rays that are worked on together, one element of a Row each. A multiple of the elements of any vector.
inline constexpr std::size_t kRays = 256;

/// A value of each ray. Kernels work on whole vectors, so elements behind the last ray may be written.
template <class T>
struct alignas(64) Row {
  T at[kRays] = {};
  T& operator[](std::size_t i) { return at[i]; }
  T operator[](std::size_t i) const { return at[i]; }
};

/// Three numbers of each ray.
struct Rows3 {
  Row<float> x, y, z;
  Vec3 get(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vec3& value) { x[i] = value.x(), y[i] = value.y(), z[i] = value.z(); }
};

/// Some rays of a batch, by index.
struct Picked {
  std::size_t count = 0;
  std::uint16_t at[kRays];
  void add(std::size_t i) { at[count++] = static_cast<std::uint16_t>(i); }
};

}  // namespace svnet::simulation
