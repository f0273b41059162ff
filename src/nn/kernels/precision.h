#pragma once
#include "base/enum_names.h"

namespace svnet::kernels {

/// What both operands of the products of compiled inference are rounded to. Everything between layers is f32, and so
/// are sums, but those of int8 are exact.
enum class Precision { f32, bf16, int8 };

/// Throws Error if the processor, or the instruction set that kernels are capped at, has no such products.
void check_available(Precision precision);

/// The precision of dense layers: they do not multiply in int8, for which they have too little work per weight.
constexpr Precision dense_precision(Precision precision) {
  return precision == Precision::int8 ? Precision::f32 : precision;
}

constexpr auto enum_table(Precision) {
  return std::to_array<EnumName<Precision>>(
      {{Precision::f32, "f32"}, {Precision::bf16, "bf16"}, {Precision::int8, "int8"}});
}

}  // namespace svnet::kernels
