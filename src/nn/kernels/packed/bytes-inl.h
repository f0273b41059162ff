// From floats to bytes. Included once for each instruction set.
#if defined(SVNET_BYTES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SVNET_BYTES_INL_H_
#undef SVNET_BYTES_INL_H_
#else
#define SVNET_BYTES_INL_H_
#endif

#include <cmath>
#include <cstdint>
#include <cstring>

#include "nn/kernels/packed/panel_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

/// to = round(y) limited to [0, 255], kLanes bytes; halves round to even, NaN becomes 0.
HWY_INLINE void store_bytes(PanelVector y, std::uint8_t* to) {
  const PanelTag d;
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  y = hn::Min(hn::Max(y, hn::Zero(d)),
              hn::Set(d, 255.0f));  // if one operand is NaN, the instruction returns the second
#if HWY_TARGET <= HWY_AVX3
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm512_cvtepi32_epi8(_mm512_cvtps_epi32(y.raw)));
#else
#if HWY_TARGET == HWY_AVX2
  const __m256i whole = _mm256_cvtps_epi32(y.raw);
  const __m128i words = _mm_packs_epi32(_mm256_castsi256_si128(whole), _mm256_extracti128_si256(whole, 1));
#else
  const __m128i whole = _mm_cvtps_epi32(y.raw), words = _mm_packs_epi32(whole, whole);
#endif
  const __m128i bytes = _mm_packus_epi16(words, words);
  std::memcpy(to, &bytes, static_cast<std::size_t>(kLanes));
#endif
#else
  alignas(kAlignment) float lanes[kLanes];
  hn::Store(y, d, lanes);
  for (Index i = 0; i < kLanes; ++i)
    to[i] = lanes[i] > 0 ? static_cast<std::uint8_t>(std::nearbyint(lanes[i] < 255 ? lanes[i] : 255.0f)) : 0;
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
