#pragma once
#include "nn/kernels/packed/tile_kernels.h"

// Products of bf16 elements with sums in f32, by the instructions of AVX512-BF16. Two neighbours along the depth make a
// pair, which has the size of one f32; the first is the low half. Pairs are stored and moved like floats: an operand of
// depth D is laid out like one of ⌈D / 2⌉ floats, so what drives f32 tiles drives these tiles too. On other processors
// than x86-64 machine_has_bf16 returns false.
namespace svnet::kernels {

inline constexpr Index pairs(Index depth) { return (depth + 1) / 2; }

/// Whether processor and operating system have AVX512-BF16. The functions below require it.
bool machine_has_bf16();

/// to (rows, `stride`) = the rows of a (rows, depth) as pairs. If depth is odd, the last pair holds a zero.
void round_to_pairs(Index rows, const PanelRows& a, Index depth, float* to, Index stride);

/// The tiles for panels [pairs][16]. The sums of a row are in order of depth and do not depend on the other rows.
TileKernels bf16_tiles();

}  // namespace svnet::kernels
