#pragma once
#include "base/enum_names.h"

namespace svnet::kernels {

/// What both operands of the products of compiled inference are rounded to. Sums and everything between layers are f32.
enum class Precision { f32, bf16 };

/// Throws Error if the processor, or the instruction set that kernels are capped at, has no such products.
void check_available(Precision precision);

constexpr auto enum_table(Precision) {
  return std::to_array<EnumName<Precision>>({{Precision::f32, "f32"}, {Precision::bf16, "bf16"}});
}

}  // namespace svnet::kernels
