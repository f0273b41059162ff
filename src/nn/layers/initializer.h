#pragma once
#include <cstdint>
#include <string>

#include "nn/tensor.h"

namespace svnet {

/// Keras' initialisers. Uniform ones draw from ±√(3 · scale / fan), normal ones from a normal distribution truncated at
/// two standard deviations, of variance scale / fan; fan is fan_in (he: scale 2, lecun: scale 1) or the mean of fan_in
/// and fan_out (glorot, scale 1). fan_in and fan_out are the last two sizes times the sizes before them.
enum class Initializer {
  zeros,
  ones,
  glorot_uniform,
  glorot_normal,
  he_uniform,
  he_normal,
  lecun_uniform,
  lecun_normal
};

/// A tensor drawn from Stream::weights of `seed`; `number` is that of the parameter in its graph. The same for any
/// number of threads.
Tensor initialised(Initializer initializer, const Shape& shape, std::uint64_t seed, std::uint32_t number,
                   DType dtype = DType::f32);

}  // namespace svnet
