#include "nn/kernels/window.h"

#include <algorithm>

#include "base/error.h"

namespace svnet {
namespace {

struct Axis {
  Index before, outputs;
};

Axis along(const char* operation, const char* axis, Index size, Index kernel, Index stride, const Padding& padding,
           Index before, Index after) {
  check(kernel > 0 && stride > 0, "[", operation, "] kernel ", kernel, " and stride ", stride, " along the ", axis,
        " must be positive");
  check(before >= 0 && after >= 0, "[", operation, "] padding along the ", axis, " is negative");
  const Index most = std::max({kernel, stride, before, after});
  check(most < kLargestWindow, "[", operation, "] a window, stride or padding of ", most, " along the ", axis,
        " is too large");
  if (padding.kind == Padding::Kind::same) {
    const Index outputs = (size + stride - 1) / stride;
    return {std::max<Index>((outputs - 1) * stride + kernel - size, 0) / 2, outputs};
  }
  if (padding.kind == Padding::Kind::valid) before = after = 0;
  const Index room = size + before + after - kernel;
  check(room >= 0, "[", operation, "] a window of ", axis, " ", kernel, " does not fit an image of ", axis, " ", size,
        " with padding ", before, " and ", after);
  return {before, room / stride + 1};
}

}  // namespace

Window::Columns Window::inner_columns() const {
  const Index first = std::min(ow, (left + stride_w - 1) / stride_w);
  return {first, w + left >= kw ? std::clamp((w + left - kw) / stride_w + 1, first, ow) : first};
}

Window Window::input_gradient(Index output_channels) const {
  Window over = *this;
  over.h = oh, over.w = ow, over.c = output_channels;
  over.oh = h, over.ow = w;
  over.top = kh - 1 - top, over.left = kw - 1 - left;
  return over;
}

Window window_over(const char* operation, Index n, Index h, Index w, Index c, const WindowOptions& o) {
  check(n >= 0 && h > 0 && w > 0 && c > 0, "[", operation, "] images of ", n, "x", h, "x", w, "x", c, " are empty");
  const Axis rows = along(operation, "height", h, o.kh, o.stride_h, o.padding, o.padding.top, o.padding.bottom);
  const Axis columns = along(operation, "width", w, o.kw, o.stride_w, o.padding, o.padding.left, o.padding.right);
  return {.n = n,
          .h = h,
          .w = w,
          .c = c,
          .kh = o.kh,
          .kw = o.kw,
          .stride_h = o.stride_h,
          .stride_w = o.stride_w,
          .top = rows.before,
          .left = columns.before,
          .oh = rows.outputs,
          .ow = columns.outputs};
}

}  // namespace svnet
