#include "nn/kernels/epilogue.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/kernels/epilogue.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svnet::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void bias_clamp_rows(const float* bias, float low, float high, Index rows, Index columns, Index stride, float* y) {
  const hn::ScalableTag<float> d;
  const Index lanes = static_cast<Index>(hn::Lanes(d));
  const auto at_least = hn::Set(d, low), at_most = hn::Set(d, high);
  for (Index row = 0; row < rows; ++row, y += stride) {
    Index c = 0;
    for (; c + lanes <= columns; c += lanes) {
      auto value = hn::LoadU(d, y + c);
      if (bias != nullptr) value = hn::Add(value, hn::LoadU(d, bias + c));
      // Comparisons rather than Min and Max, which treat NaN differently on each instruction set: NaN stays NaN.
      value = hn::IfThenElse(hn::Lt(value, at_least), at_least, value);
      hn::StoreU(hn::IfThenElse(hn::Gt(value, at_most), at_most, value), d, y + c);
    }
    for (; c < columns; ++c) {
      const float value = bias != nullptr ? y[c] + bias[c] : y[c];
      y[c] = value < low ? low : value > high ? high : value;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace svnet::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svnet::kernels {

HWY_EXPORT(bias_clamp_rows);

void apply(const Epilogue<float>& epilogue, Index rows, Index columns, Index stride, float* y) {
  if (epilogue.empty()) return;
  const auto [low, high] = range_of(epilogue.clamp);
  HWY_DYNAMIC_DISPATCH(bias_clamp_rows)(epilogue.bias, low, high, rows, columns, stride, y);
}

template <class T>
void apply_reference(const Epilogue<T>& epilogue, Index rows, Index columns, Index stride, T* y) {
  const auto range = range_of<T>(epilogue.clamp);
  for (Index row = 0; row < rows; ++row)
    for (Index c = 0; c < columns; ++c) {
      T& value = y[row * stride + c];
      if (epilogue.bias != nullptr) value += epilogue.bias[c];
      value = range.clamped(value);
    }
}
template void apply_reference<float>(const Epilogue<float>&, Index, Index, Index, float*);
template void apply_reference<double>(const Epilogue<double>&, Index, Index, Index, double*);

}  // namespace svnet::kernels
#endif
