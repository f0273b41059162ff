#pragma once

namespace svnet::kernels {

/// What both operands of the products of compiled inference are rounded to. Sums, and all that lies between layers, are
/// f32 either way.
enum class Precision { f32, bf16 };

/// What SVNET_PRECISION=f32|bf16 asks for; f32 without it. Throws Error for another word.
Precision precision_from_environment();

/// Throws Error where the machine, or the instruction set that kernels are capped at, has no such products.
void check_available(Precision precision);

}  // namespace svnet::kernels
