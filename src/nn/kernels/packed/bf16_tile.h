#pragma once
#include "nn/kernels/packed/panel.h"

// Products of bf16 numbers, summed in f32, by the instructions of AVX512-BF16. Two neighbours along k make a pair of
// the size of one f32 (the first in the low half), and pairs are stored and moved as if they were one: a product of k
// numbers is laid out as one of ⌈k / 2⌉ floats, and what drives f32 tiles drives these. Compilers without those
// instructions give a library that has none of this.
namespace svnet::kernels {

inline constexpr Index pairs(Index k) { return (k + 1) / 2; }

/// x rounded to the nearest bf16, ties to even, as the upper half of an f32; NaN stays NaN.
std::uint32_t bf16_bits(float x);

/// Whether processor and operating system have AVX512-BF16. What follows may be called only then.
bool machine_has_bf16();

/// to (rows, `stride`) = the rows of a, whose k numbers become pairs; an odd one has a zero beside it.
void round_to_pairs(Index rows, const PanelRows& a, Index k, float* to, Index stride);

/// The kernels of 1, …, kMostTileRows rows times 1 or 2 panels [pairs][16], which they take for floats. A row's sums
/// are in order of k and do not depend on its neighbours.
const MultiplyTile* bf16_tiles(int panels);

}  // namespace svnet::kernels
