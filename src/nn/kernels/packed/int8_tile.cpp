// The register tile of products of bytes (int8_tile.h), for every instruction set but AVX512-VNNI.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/packed/int8_tile.cpp"
#include "nn/kernels/packed/int8_tile.h"

#include <array>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/panel_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// As kTileRows, with one more register for the products of 16 bits.
#if HWY_TARGET == HWY_SCALAR
inline constexpr int kByteTileRows = 1, kByteTilePanels = 1;
#elif HWY_TARGET <= HWY_AVX3 && HWY_ARCH_X86
inline constexpr int kByteTileRows = HWY_MIN(13, kMostTileRows), kByteTilePanels = 2;
#elif HWY_ARCH_X86 && HWY_MAX_BYTES == 16
inline constexpr int kByteTileRows = 3, kByteTilePanels = 1;
#else
inline constexpr int kByteTileRows = HWY_MIN(6, kMostTileRows), kByteTilePanels = 1;
#endif
static_assert(kByteTileRows <= kMostTileRows && kByteTilePanels <= kMostTilePanels);

using SumTag = hn::CappedTag<std::int32_t, kPanel>;
using SumVector = hn::Vec<SumTag>;

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4  // better ones have smaller numbers; SSE2 lacks vpmaddubsw
/// sum + the products of the four bytes of each lane. No sum of two products saturates.
#if HWY_TARGET <= HWY_AVX3
HWY_INLINE SumVector add_products(SumVector sum, SumVector bytes, SumVector weights) {
  const __m512i twos = _mm512_maddubs_epi16(bytes.raw, weights.raw);
  return SumVector{_mm512_add_epi32(sum.raw, _mm512_madd_epi16(twos, _mm512_set1_epi16(1)))};
}
#elif HWY_TARGET == HWY_AVX2
HWY_INLINE SumVector add_products(SumVector sum, SumVector bytes, SumVector weights) {
  const __m256i twos = _mm256_maddubs_epi16(bytes.raw, weights.raw);
  return SumVector{_mm256_add_epi32(sum.raw, _mm256_madd_epi16(twos, _mm256_set1_epi16(1)))};
}
#else
HWY_INLINE SumVector add_products(SumVector sum, SumVector bytes, SumVector weights) {
  const __m128i twos = _mm_maddubs_epi16(bytes.raw, weights.raw);
  return SumVector{_mm_add_epi32(sum.raw, _mm_madd_epi16(twos, _mm_set1_epi16(1)))};
}
#endif
#else
/// The same byte by byte: shifts bring byte i of a lane to the top, and then, with its sign or without, to the bottom.
HWY_INLINE SumVector add_products(SumVector sum, SumVector bytes, SumVector weights) {
  const SumTag d;
  const hn::RebindToUnsigned<SumTag> du;
  const auto unsigned_bytes = hn::BitCast(du, bytes);
  unrolled<4>([&](auto i) HWY_ATTR {
    const auto byte = hn::BitCast(d, hn::ShiftRight<24>(hn::ShiftLeft<24 - 8 * i>(unsigned_bytes)));
    sum = hn::Add(sum, hn::Mul(byte, hn::ShiftRight<24>(hn::ShiftLeft<24 - 8 * i>(weights))));
  });
  return sum;
}
#endif

/// A MultiplyTile (panel.h) of kRows rows and kPanels panels of quads.
template <int kRows, int kPanels>
HWY_NOINLINE HWY_FLATTEN void multiply_byte_tile(const PanelRows& a, Index depth, const float* panel,
                                                 Index panel_stride, const TileOutput& out) {
  const PanelTag d;
  const SumTag di;
  constexpr int kVectors = kPanels * kVectorsPerPanel;
  const TileFinish& finish = *out.finish;
  SumVector sum[kRows][kVectors];
  const auto for_each_vector = [&](const auto& body) HWY_ATTR {
    unrolled<kRows>([&](auto r) HWY_ATTR { unrolled<kVectors>([&](auto v) HWY_ATTR { body(r, v); }); });
  };
  for_each_vector([&](auto r, auto v) HWY_ATTR { sum[r][v] = hn::LoadU(di, finish.start + in_panel(v, kPanel)); });
  const Index run = a.block_stride == a.run ? depth : a.run;
  const float* block = a.data;
  for (Index rest = depth; rest > 0; rest -= run, block += a.block_stride, panel += run * kPanel) {
    const Index count = HWY_MIN(run, rest);
    for (Index i = 0; i < count; ++i) {
      __builtin_prefetch(panel + i * kPanel + out.prefetch_distance, 0, 2);
      SumVector b[kVectors];
      unrolled<kVectors>([&](auto v) HWY_ATTR {
        b[v] = hn::BitCast(di, hn::Load(d, panel + i * kPanel + in_panel(v, panel_stride)));
      });
      unrolled<kRows>([&](auto r) HWY_ATTR {
        const SumVector x = hn::BitCast(di, hn::Set(d, block[r * a.row_stride + i]));
        unrolled<kVectors>([&](auto v) HWY_ATTR { sum[r][v] = add_products(sum[r][v], x, b[v]); });
      });
    }
  }
  const auto low = hn::Set(d, finish.low), high = hn::Set(d, finish.high);
  const bool is_whole = out.columns >= kPanels * kPanel;
  for_each_vector([&](auto r, auto v) HWY_ATTR {
    // Not a fused product and sum: machines without it would give other bits.
    auto y = hn::Add(hn::Mul(hn::ConvertTo(d, sum[r][v]), hn::LoadU(d, finish.scale + in_panel(v, kPanel))),
                     hn::LoadU(d, finish.bias + in_panel(v, kPanel)));
    if (finish.residual != nullptr)
      y = hn::Add(y, hn::LoadU(d, finish.residual + r * finish.residual_stride + in_panel(v, kPanel)));
    y = clamped(y, low, high);
    float* const to = out.c + r * out.stride + in_panel(v, out.panel_stride);
    if (is_whole)
      hn::StoreU(y, d, to);
    else
      store_first(lanes_within(v, out.columns), y, to);
  });
}

template <int kPanels, int... rows>
constexpr auto byte_kernels_by_rows(std::integer_sequence<int, rows...>) {
  return std::array<MultiplyTile, sizeof...(rows)>{&multiply_byte_tile<rows + 1, kPanels>...};
}
template <int kPanels>
inline constexpr auto kByteKernels = byte_kernels_by_rows<kPanels>(std::make_integer_sequence<int, kByteTileRows>{});

TileKernels int8_kernels() {
  return {kByteTileRows, kByteTilePanels, kByteKernels<1>.data(), kByteKernels<kByteTilePanels>.data()};
}
bool is_avx3() { return HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3; }

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(int8_kernels);
HWY_EXPORT(is_avx3);

TileKernels int8_tiles_without_vnni() { return HWY_DYNAMIC_DISPATCH(int8_kernels)(); }

TileKernels int8_tiles() {
  static const bool has_vnni = machine_has_vnni();
  return has_vnni && HWY_DYNAMIC_DISPATCH(is_avx3)() ? vnni_tiles() : int8_tiles_without_vnni();
}

}  // namespace svnet::kernels
#endif
