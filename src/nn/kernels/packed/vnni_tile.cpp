#include <array>
#include <utility>

#include "nn/kernels/packed/int8_tile.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define SVNET_VNNI __attribute__((target("avx512f,avx512bw,avx512vl,avx512vnni")))

namespace svnet::kernels {
namespace {

constexpr __mmask16 kWholePanel = 0xffff;

template <int kRows, int kPanels>
SVNET_VNNI void multiply_vnni_tile(const PanelRows& a, Index depth, const float* panel, Index panel_stride,
                                   const TileOutput& out) {
  const TileFinish& finish = *out.finish;
  __m512i sum[kRows][kPanels];
#pragma GCC unroll 14
  for (int r = 0; r < kRows; ++r)
    for (int p = 0; p < kPanels; ++p) sum[r][p] = _mm512_loadu_si512(finish.start + p * kPanel);
  const Index run = a.block_stride == a.run ? depth : a.run;
  const float* block = a.data;
  for (Index rest = depth; rest > 0; rest -= run, block += a.block_stride, panel += run * kPanel) {
    const Index count = rest < run ? rest : run;
    for (Index i = 0; i < count; ++i) {
      __builtin_prefetch(panel + i * kPanel + out.prefetch_distance, 0, 2);
      __m512i b[kPanels];
      for (int p = 0; p < kPanels; ++p) b[p] = _mm512_load_si512(panel + p * panel_stride + i * kPanel);
#pragma GCC unroll 14
      for (int r = 0; r < kRows; ++r) {
        const __m512i x = _mm512_castps_si512(_mm512_set1_ps(block[r * a.row_stride + i]));
        for (int p = 0; p < kPanels; ++p) sum[r][p] = _mm512_dpbusd_epi32(sum[r][p], x, b[p]);
      }
    }
  }
  const __m512 low = _mm512_set1_ps(finish.low), high = _mm512_set1_ps(finish.high);
  for (int p = 0; p < kPanels; ++p) {
    const Index columns = out.columns - p * kPanel;
    const auto mask = static_cast<__mmask16>(columns >= kPanel ? 0xffff : columns <= 0 ? 0 : (1 << columns) - 1);
    const __m512 scale = _mm512_loadu_ps(finish.scale + p * kPanel), bias = _mm512_loadu_ps(finish.bias + p * kPanel);
#pragma GCC unroll 14
    for (int r = 0; r < kRows; ++r) {
      // Not a fused product and sum: machines without it would give other bits. (Without masks GCC 12 warns of its own
      // header.)
      __m512 y = _mm512_add_ps(_mm512_mul_ps(_mm512_maskz_cvtepi32_ps(kWholePanel, sum[r][p]), scale), bias);
      if (finish.residual != nullptr)
        y = _mm512_add_ps(y, _mm512_loadu_ps(finish.residual + r * finish.residual_stride + p * kPanel));
      y = _mm512_maskz_min_ps(kWholePanel, high, _mm512_maskz_max_ps(kWholePanel, low, y));
      _mm512_mask_storeu_ps(out.c + r * out.stride + p * out.panel_stride, mask, y);
    }
  }
}

template <int kPanels, int... rows>
constexpr auto vnni_by_rows(std::integer_sequence<int, rows...>) {
  return std::array<MultiplyTile, sizeof...(rows)>{&multiply_vnni_tile<rows + 1, kPanels>...};
}
template <int kPanels>
constexpr auto kVnniTiles = vnni_by_rows<kPanels>(std::make_integer_sequence<int, kMostTileRows>{});

}  // namespace

bool machine_has_vnni() { return __builtin_cpu_supports("avx512vnni"); }
TileKernels vnni_tiles() { return {kMostTileRows, kMostTilePanels, kVnniTiles<1>.data(), kVnniTiles<2>.data()}; }

}  // namespace svnet::kernels

#else

namespace svnet::kernels {

bool machine_has_vnni() { return false; }
TileKernels vnni_tiles() { return {}; }

}  // namespace svnet::kernels
#endif
