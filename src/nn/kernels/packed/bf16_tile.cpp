#include "nn/kernels/packed/bf16_tile.h"

#include <array>
#include <cassert>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>

#define SVNET_BF16 __attribute__((target("avx512f,avx512bw,avx512vl,avx512bf16")))

namespace svnet::kernels {
namespace {

SVNET_BF16 inline __m512bh as_pairs(__m512 v) { return reinterpret_cast<__m512bh>(v); }

constexpr __mmask16 kAll = 0xffff;

template <int kRows, int kPanels>
SVNET_BF16 void multiply_tile(const PanelRows& a, Index depth, const float* panel, Index panel_stride,
                              const TileOutput& out) {
  __m512 sum[kRows][kPanels];
  __mmask16 columns[kPanels];
  for (int p = 0; p < kPanels; ++p) {
    const Index count = out.columns - p * kPanel;
    columns[p] = static_cast<__mmask16>(count >= kPanel ? 0xffff : count <= 0 ? 0 : (1 << count) - 1);
  }
#pragma GCC unroll 14
  for (int r = 0; r < kRows; ++r)
    for (int p = 0; p < kPanels; ++p)
      sum[r][p] = out.accumulate ? _mm512_maskz_loadu_ps(columns[p], out.c + r * out.stride + p * out.panel_stride)
                                 : _mm512_setzero_ps();
  for (Index i = 0; i < depth; ++i) {
    __builtin_prefetch(panel + i * kPanel + out.prefetch_distance, 0, 2);
    __m512bh b[kPanels];
    for (int p = 0; p < kPanels; ++p) b[p] = as_pairs(_mm512_load_ps(panel + p * panel_stride + i * kPanel));
#pragma GCC unroll 14
    for (int r = 0; r < kRows; ++r) {
      const __m512bh x = as_pairs(_mm512_set1_ps(a.data[r * a.row_stride + i]));
      for (int p = 0; p < kPanels; ++p) sum[r][p] = _mm512_dpbf16_ps(sum[r][p], b[p], x);
    }
  }
  if (out.finish != nullptr) {
    const TileFinish& finish = *out.finish;
    const __m512 low = _mm512_set1_ps(finish.low), high = _mm512_set1_ps(finish.high);
#pragma GCC unroll 14
    for (int r = 0; r < kRows; ++r)
      for (int p = 0; p < kPanels; ++p) {
        __m512 y = _mm512_add_ps(sum[r][p], _mm512_loadu_ps(finish.bias + p * kPanel));
        if (finish.residual != nullptr)
          y = _mm512_add_ps(y, _mm512_loadu_ps(finish.residual + r * finish.residual_stride + p * kPanel));
        // If one operand is NaN, these instructions return the second. (Without a mask GCC 12 warns of its own header.)
        sum[r][p] = _mm512_maskz_min_ps(kAll, high, _mm512_maskz_max_ps(kAll, low, y));
      }
  }
#pragma GCC unroll 14
  for (int r = 0; r < kRows; ++r)
    for (int p = 0; p < kPanels; ++p)
      _mm512_mask_storeu_ps(out.c + r * out.stride + p * out.panel_stride, columns[p], sum[r][p]);
}

template <int kPanels, int... rows>
constexpr auto tile_kernels(std::integer_sequence<int, rows...>) {
  return std::array<MultiplyTile, sizeof...(rows)>{&multiply_tile<rows + 1, kPanels>...};
}
template <int kPanels>
constexpr auto kTiles = tile_kernels<kPanels>(std::make_integer_sequence<int, kMostTileRows>{});

}  // namespace

bool machine_has_bf16() { return __builtin_cpu_supports("avx512bf16"); }

SVNET_BF16 void round_to_pairs(Index rows, const PanelRows& a, Index depth, float* to, Index stride) {
  if (depth % 2 != 0)
    for (Index r = 0; r < rows; ++r) to[r * stride + depth / 2] = 0;
  const Index run = a.block_stride == a.run ? depth : a.run;
  for (Index begin = 0; begin < depth; begin += run) {
    const float* block = a.data + begin / run * a.block_stride;
    const Index count = begin + run < depth ? run : depth - begin;
    for (Index r = 0; r < rows; ++r) {
      const float* from = block + r * a.row_stride;
      char* out = reinterpret_cast<char*>(to + r * stride) + 2 * begin;
      Index i = 0;
      for (; i + 32 <= count; i += 32) {
        const __m512 low = _mm512_loadu_ps(from + i), high = _mm512_loadu_ps(from + i + 16);
        _mm512_storeu_si512(out + 2 * i, reinterpret_cast<__m512i>(_mm512_cvtne2ps_pbh(high, low)));
      }
      for (; i < count; i += 16) {
        const auto mask = static_cast<__mmask16>(count - i >= 16 ? 0xffff : (1 << (count - i)) - 1);
        const __m512 values = _mm512_maskz_loadu_ps(mask, from + i);
        _mm256_mask_storeu_epi16(out + 2 * i, mask, reinterpret_cast<__m256i>(_mm512_cvtneps_pbh(values)));
      }
    }
  }
}

TileKernels bf16_tiles() { return {kMostTileRows, kMostTilePanels, kTiles<1>.data(), kTiles<2>.data()}; }

}  // namespace svnet::kernels

#else

namespace svnet::kernels {

bool machine_has_bf16() { return false; }
void round_to_pairs(Index, const PanelRows&, Index, float*, Index) { assert(false); }
TileKernels bf16_tiles() { return {}; }

}  // namespace svnet::kernels
#endif
