#include "nn/kernels/packed/byte_input.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/packed/byte_input.cpp"
#include <algorithm>
#include <cmath>
#include <cstring>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/packed/bytes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {

void bytes_of_rows(Index rows, const PanelRows& a, Index depth, const ByteInput& input, float* to, Index stride) {
  const PanelTag d;
  const Index run = a.block_stride == a.run ? depth : a.run;
  for (Index begin = 0; begin < depth; begin += run) {
    const float* block = a.data + begin / run * a.block_stride;
    const float *factor = input.factor.get() + begin, *zero = input.zero.get() + begin;
    const Index count = HWY_MIN(run, depth - begin);
    for (Index r = 0; r < rows; ++r) {
      const float* from = block + r * a.row_stride;
      std::uint8_t* bytes = reinterpret_cast<std::uint8_t*>(to + r * stride) + begin;
      const auto vector = [&](Index at) HWY_ATTR {
        return hn::Add(hn::Mul(hn::LoadU(d, from + at), hn::LoadU(d, factor + at)), hn::LoadU(d, zero + at));
      };
      Index i = 0;
      for (; i + kLanes <= count; i += kLanes) store_bytes(vector(i), bytes + i);
      if (i == count) continue;
      std::uint8_t last[kPanel];  // a whole vector might reach into the next row
      store_bytes(vector(i), last);
      std::memcpy(bytes + i, last, static_cast<std::size_t>(count - i));
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(bytes_of_rows);

ByteInput byte_input(Index depth, const ChannelRanges& ranges) {
  const Index padded = panels(depth) * kPanel, channels = static_cast<Index>(ranges.low.size());
  ByteInput input{aligned_floats(padded + kPanel), aligned_floats(padded + kPanel)};
  std::fill_n(input.factor.get(), padded + kPanel, 0.0f);
  std::fill_n(input.zero.get(), padded + kPanel, 0.0f);
  for (Index i = 0; i < depth; ++i) {
    const auto channel = static_cast<std::size_t>(i % channels);
    const double low = std::min(0.0f, ranges.low[channel]), high = std::max(0.0f, ranges.high[channel]);
    if (!(high > low)) continue;
    const double factor = 255 / (high - low);
    if (!std::isfinite(static_cast<float>(factor))) continue;  // as good as 0
    input.factor.get()[i] = static_cast<float>(factor);
    input.zero.get()[i] = static_cast<float>(std::nearbyint(-low * factor));
  }
  return input;
}

void round_to_quads(Index rows, const PanelRows& a, Index depth, const ByteInput& input, float* to, Index stride) {
  HWY_DYNAMIC_DISPATCH(bytes_of_rows)(rows, a, depth, input, to, stride);
}

}  // namespace svnet::kernels
#endif
