// y = clamp(x·scale + shift) per channel, vectorised over channels.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/batch_norm/scale_shift.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/kernels/batch_norm/batch_norm.h"

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void scale_shift_rows(Index rows, Index channels, const float* x, const float* scale, const float* shift, float low,
                      float high, float* y) {
  const hn::ScalableTag<float> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  const auto at_least = hn::Set(d, low), at_most = hn::Set(d, high);
  for (Index row = 0; row < rows; ++row, x += channels, y += channels) {
    Index c = 0;
    for (; c + lanes <= channels; c += lanes) {
      const auto value = hn::MulAdd(hn::LoadU(d, x + c), hn::LoadU(d, scale + c), hn::LoadU(d, shift + c));
      // Comparisons rather than Min and Max, which treat NaN differently on each instruction set: NaN stays NaN.
      const auto raised = hn::IfThenElse(hn::Lt(value, at_least), at_least, value);
      hn::StoreU(hn::IfThenElse(hn::Gt(raised, at_most), at_most, raised), d, y + c);
    }
    for (; c < channels; ++c) {
      const float value = x[c] * scale[c] + shift[c];
      y[c] = value < low ? low : value > high ? high : value;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(scale_shift_rows);

void scale_shift(Parallel& parallel, const RowsShape& s, const float* x, const float* scale, const float* shift,
                 Clamp clamp, float* y) {
  const auto range = range_of(clamp);
  parallel.for_chunks(
      s.rows, std::max<Index>(1, 16384 / std::max<Index>(s.channels, 1)), [&](Index begin, Index end, int) {
        HWY_DYNAMIC_DISPATCH(scale_shift_rows)
        (end - begin, s.channels, x + begin * s.channels, scale, shift, range.low, range.high, y + begin * s.channels);
      });
}

}  // namespace svnet::kernels
#endif
