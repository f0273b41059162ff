#pragma once
#include "base/enum_names.h"
#include "base/index.h"

namespace svnet {

/// How a window meets the border, as in Keras: valid keeps whole windows; same gives ⌈size / stride⌉ outputs and puts
/// the odd zero at the bottom and right; or the given numbers of zeros.
struct Padding {
  enum class Kind { valid, same, explicit_ };
  Kind kind = Kind::valid;
  Index top = 0, bottom = 0, left = 0, right = 0;

  static Padding valid() { return {}; }
  static Padding same() { return {.kind = Kind::same}; }
  static Padding of(Index top, Index bottom, Index left, Index right) {
    return {.kind = Kind::explicit_, .top = top, .bottom = bottom, .left = left, .right = right};
  }
  bool operator==(const Padding&) const = default;
};

template <>
inline constexpr auto enum_names<Padding::Kind> = std::to_array<EnumName<Padding::Kind>>(
    {{Padding::Kind::valid, "valid"}, {Padding::Kind::same, "same"}, {Padding::Kind::explicit_, "explicit"}});

/// Sizes of windows, strides and paddings are smaller, so that sums of them fit.
constexpr Index kLargestWindow = Index{1} << 31;

/// A window that slides over images x (N, H, W, C) and gives (N, OH, OW, …): what convolution and pooling share.
/// Window (oh, ow) covers rows oh·stride_h − top + [0, kh) and columns ow·stride_w − left + [0, kw).
struct Window {
  Index n, h, w, c;
  Index kh, kw, stride_h, stride_w;
  Index top, left;
  Index oh, ow;

  Index positions() const { return n * oh * ow; }
  /// The output columns whose windows reach neither out of the left nor out of the right side of the image.
  struct Columns {
    Index first, last;  // [first, last), perhaps none
  };
  Columns inner_columns() const;
  /// The window that, sliding over dy (N, OH, OW, k), gives the gradient of this one's input, of which it covers all
  /// pixels, with the weights flipped along both axes. Strides must be 1.
  Window input_gradient(Index k) const;
  /// Whether each window is one pixel, in the image's order.
  bool reads_in_place() const {
    return kh == 1 && kw == 1 && stride_h == 1 && stride_w == 1 && top == 0 && left == 0 && oh == h && ow == w;
  }
};

/// What describes a window before the image is known.
struct WindowOptions {
  Index kh = 1, kw = 1, stride_h = 1, stride_w = 1;
  Padding padding{};
};

/// Throws Error, prefixed by [operation], where a size (other than n) is not positive or the window does not fit the
/// padded image.
Window window_over(const char* operation, Index n, Index h, Index w, Index c, const WindowOptions& options);

}  // namespace svnet
