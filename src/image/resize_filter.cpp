// Along rows, a vector holds two taps of one target pixel in each of its blocks of 16 bytes, as pairs of 16 bits: red
// of both, green of both, blue of both, zeros. The weights are cut into their upper 8 and lower 15 bits, so that one
// instruction multiplies pairs and adds their products; the halves are put together at the end. Sums wrap around as
// those of the plain version would, so the bits are the same. Along columns, vectors hold values of a row.
#include "image/resize_filter.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/resize_filter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svnet {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

void width_pass(const ResizeFilter& filter, const std::uint8_t* in, Index rows, Index from, Index to, std::uint8_t* out,
                WidthBuffers&) {
  filter_width_reference(filter, in, rows, from, to, out);
}

void height_pass(const ResizeFilter& filter, const std::uint8_t* in, Index row_size, Index to, std::uint8_t* out) {
  filter_height_reference(filter, in, row_size, to, out);
}

#else

using Bytes = hn::CappedTag<std::uint8_t, 32>;
using Halves = hn::Repartition<std::int16_t, Bytes>;
using Words = hn::Repartition<std::int32_t, Bytes>;
constexpr Index kBlocks = static_cast<Index>(hn::MaxLanes(Bytes()) / 16);
constexpr Index kTaps = 2 * kBlocks;  // of a vector
constexpr int kLowBits = 15;

/// The sums of the products of neighbours.
template <class V>
HWY_INLINE hn::Vec<Words> pair_products(V a, V b) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4  // better ones have smaller numbers; emulated vectors are summed otherwise
  constexpr Words words;
  auto none = hn::Zero(words);
  return hn::ReorderWidenMulAccumulate(words, a, b, hn::Zero(words), none);  // neighbours stay together
#else
  const auto even = [](V v) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(hn::BitCast(Words(), v))); };
  const auto odd = [](V v) { return hn::ShiftRight<16>(hn::BitCast(Words(), v)); };
  return hn::Add(hn::Mul(even(a), even(b)), hn::Mul(odd(a), odd(b)));
#endif
}

using Block = hn::CappedTag<std::int32_t, 4>;

template <class V>
HWY_INLINE hn::Vec<Block> sum_of_blocks(V sums) {
  if constexpr (kBlocks == 2)
    return hn::Add(hn::LowerHalf(Block(), sums), hn::UpperHalf(Block(), sums));
  else
    return sums;
}

/// For each target and each of its vectors of taps, the upper and then the lower parts of the weights.
void lay_out(const ResizeFilter& filter, Index to, Index vectors, std::vector<std::int16_t>& weights) {
  weights.assign(static_cast<std::size_t>(to * vectors * 2 * 8 * kBlocks), 0);
  std::int16_t* part = weights.data();
  for (Index i = 0; i < to; ++i)
    for (Index first = 0; first < vectors * kTaps; first += kTaps)
      for (const bool upper : {true, false})
        for (Index t = first; t < first + kTaps; t += 2, part += 8)
          for (Index pair = 0; pair < 2; ++pair) {
            if (t + pair >= filter.counts[i]) continue;
            const std::int32_t weight = filter.weights[i * filter.taps + t + pair];
            const auto value = static_cast<std::int16_t>(upper ? weight >> kLowBits : weight & ((1 << kLowBits) - 1));
            for (Index channel = 0; channel < 3; ++channel) part[2 * channel + pair] = value;
          }
}

/// One row. Reads up to 16 kBlocks bytes after the last tap of each target.
void width_row(const ResizeFilter& filter, const std::int16_t* weights, const std::uint8_t* in, Index to, Index vectors,
               std::uint8_t* out) {
  constexpr Bytes bytes;
  constexpr Halves halves;
  constexpr Words words;
  constexpr Block block;
  constexpr std::uint8_t kZero = 0x80;
  HWY_ALIGN constexpr std::uint8_t kPairs[32] = {
      0, kZero, 3, kZero, 1, kZero, 4,  kZero, 2, kZero, 5,  kZero, kZero, kZero, kZero, kZero,
      6, kZero, 9, kZero, 7, kZero, 10, kZero, 8, kZero, 11, kZero, kZero, kZero, kZero, kZero};
  const auto pairs = hn::Load(bytes, kPairs);
  const auto half = hn::Set(block, 1 << (kFilterBits - 1));
  for (Index i = 0; i < to; ++i) {
    const std::uint8_t* taps = in + filter.starts[i] * 3;
    auto upper = hn::Zero(words), lower = hn::Zero(words);
    for (Index v = 0; v < vectors; ++v, taps += 3 * kTaps, weights += 16 * kBlocks) {
      const auto source = hn::BitCast(halves, hn::TableLookupBytesOr0(hn::LoadDup128(bytes, taps), pairs));
      upper = hn::Add(upper, pair_products(source, hn::LoadU(halves, weights)));
      lower = hn::Add(lower, pair_products(source, hn::LoadU(halves, weights + 8 * kBlocks)));
    }
    const auto sums = hn::Add(hn::ShiftLeft<kLowBits>(upper), lower);
    const auto sum = hn::ShiftRight<kFilterBits>(hn::Add(sum_of_blocks(sums), half));
    const auto pixel = hn::DemoteTo(hn::Rebind<std::uint8_t, decltype(block)>(), sum);
    const std::uint32_t rgb =
        hn::GetLane(hn::BitCast(hn::Repartition<std::uint32_t, hn::DFromV<decltype(pixel)> >(), pixel));
    std::memcpy(out + 3 * i, &rgb, 3);
  }
}

void width_pass(const ResizeFilter& filter, const std::uint8_t* in, Index rows, Index from, Index to, std::uint8_t* out,
                WidthBuffers& buffers) {
  const Index most = *std::max_element(filter.counts.begin(), filter.counts.end());
  const Index vectors = (most + kTaps - 1) / kTaps;
  lay_out(filter, to, vectors, buffers.weights);
  const Index row_size = 3 * from, after = 3 * kTaps * vectors + 16;
  for (Index row = 0; row < rows; ++row) {
    const std::uint8_t* source = in + row * row_size;
    if ((rows - row - 1) * row_size < after) {  // less follows than is read
      buffers.last_row.assign(static_cast<std::size_t>(row_size + after), 0);
      std::copy_n(source, row_size, buffers.last_row.begin());
      source = buffers.last_row.data();
    }
    width_row(filter, buffers.weights.data(), source, to, vectors, out + row * to * 3);
  }
}

/// The values [x, x + vectors of four) of one target row.
template <Index kVectors>
void height_values(const std::int32_t* weights, Index count, const std::uint8_t* in, Index row_size,
                   std::uint8_t* out) {
  constexpr Words words;
  constexpr hn::Rebind<std::uint8_t, Words> bytes;
  const Index lanes = static_cast<Index>(hn::Lanes(words));
  hn::Vec<Words> sums[kVectors];
  for (auto& sum : sums) sum = hn::Set(words, 1 << (kFilterBits - 1));
  for (Index t = 0; t < count; ++t, in += row_size) {
    const auto weight = hn::Set(words, weights[t]);
    for (Index v = 0; v < kVectors; ++v)
      sums[v] = hn::Add(sums[v], hn::Mul(weight, hn::PromoteTo(words, hn::LoadU(bytes, in + v * lanes))));
  }
  for (Index v = 0; v < kVectors; ++v)
    hn::StoreU(hn::DemoteTo(bytes, hn::ShiftRight<kFilterBits>(sums[v])), bytes, out + v * lanes);
}

void height_pass(const ResizeFilter& filter, const std::uint8_t* in, Index row_size, Index to, std::uint8_t* out) {
  const Index lanes = static_cast<Index>(hn::Lanes(Words()));
  for (Index row = 0; row < to; ++row, out += row_size) {
    const std::int32_t* weights = filter.weights.data() + row * filter.taps;
    const std::uint8_t* from = in + filter.starts[row] * row_size;
    const Index count = filter.counts[row];
    Index x = 0;
    for (; x + 4 * lanes <= row_size; x += 4 * lanes) height_values<4>(weights, count, from + x, row_size, out + x);
    for (; x + lanes <= row_size; x += lanes) height_values<1>(weights, count, from + x, row_size, out + x);
    for (; x < row_size; ++x) {
      std::int32_t sum = 1 << (kFilterBits - 1);
      for (Index t = 0; t < count; ++t) sum += weights[t] * from[t * row_size + x];
      out[x] = static_cast<std::uint8_t>(std::clamp(sum >> kFilterBits, 0, 255));
    }
  }
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace svnet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet {

HWY_EXPORT(width_pass);
HWY_EXPORT(height_pass);

void filter_width(const ResizeFilter& filter, const std::uint8_t* in, Index rows, Index from, Index to,
                  std::uint8_t* out, WidthBuffers& buffers) {
  HWY_DYNAMIC_DISPATCH(width_pass)(filter, in, rows, from, to, out, buffers);
}

void filter_height(const ResizeFilter& filter, const std::uint8_t* in, Index row_size, Index to, std::uint8_t* out) {
  HWY_DYNAMIC_DISPATCH(height_pass)(filter, in, row_size, to, out);
}

}  // namespace svnet
#endif
