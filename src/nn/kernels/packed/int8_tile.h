#pragma once
#include "nn/kernels/packed/tile_kernels.h"

// Products of bytes with exact sums in 32 bits: unsigned bytes on the left, weights in [-kLargestByteWeight,
// kLargestByteWeight] on the right. Four neighbours along the depth make a quad, which has the size of one f32; the
// first is the lowest byte. Quads are stored and moved like floats: an operand of depth D is laid out like one of
// ⌈D / 4⌉ floats, and what drives f32 tiles drives these tiles too.
//
// A tile multiplies the whole depth: TileOutput::finish is required, TileOutput::accumulate is not supported. Sums are
// exact and what is done to them after that is the same sequence of f32 operations everywhere, so all instruction sets
// give the same bits.
namespace svnet::kernels {

inline constexpr Index quads(Index depth) { return (depth + 3) / 4; }

/// With these weights vpmaddubsw, the product of bytes before AVX512-VNNI, never saturates: 2 · 255 · 64 < 2^15.
inline constexpr int kLargestByteWeight = 64;
/// A sum of more products might leave 32 bits.
inline constexpr Index kMostByteDepth = (Index{1} << 31) / (256 * kLargestByteWeight) - 1;

/// The tiles of the instruction set in force; with AVX512-VNNI if the machine has it and AVX-512 may be used.
TileKernels int8_tiles();
/// The tiles without AVX512-VNNI, for tests.
TileKernels int8_tiles_without_vnni();

/// Whether processor and operating system have AVX512-VNNI. Otherwise vnni_tiles has no tiles.
bool machine_has_vnni();
TileKernels vnni_tiles();

}  // namespace svnet::kernels
