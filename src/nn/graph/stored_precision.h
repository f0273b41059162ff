#pragma once
#include <string_view>

#include "base/enum_names.h"
#include "nn/tensor.h"

namespace svnet {

/// How a file holds the kernels of convolutions and dense layers:
///   f32   as they are
///   bf16  rounded to bfloat16
///   int8  as whole numbers with a scale per output channel (nn/kernels/int8/int8_weights.h)
/// Everything else (biases, norms, small kernels) is f32 in all of them: it takes little space and much of the error.
enum class StoredPrecision { f32, bf16, int8 };
constexpr auto enum_table(StoredPrecision) {
  return std::to_array<EnumName<StoredPrecision>>(
      {{StoredPrecision::f32, "f32"}, {StoredPrecision::bf16, "bf16"}, {StoredPrecision::int8, "int8"}});
}

/// Whether the parameter `name` ("layer/kernel") of this shape is rounded: kernels of at least 4,096 weights, except
/// those of depthwise convolutions.
inline bool is_rounded(std::string_view name, const Shape& shape) {
  constexpr Index kSmall = 4096;
  return (name.ends_with("/kernel") || name.ends_with("/pointwise_kernel")) && element_count(shape) >= kSmall;
}

}  // namespace svnet
