#pragma once
#include "base/enum_names.h"
#include "base/index.h"

namespace svnet {

/// Zeros around an image, as in Keras. valid: none, only whole windows count. same: as many as give ⌈size / stride⌉
/// outputs; an odd zero is at the bottom and right. explicit_: the given numbers.
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

constexpr auto enum_table(Padding::Kind) {
  return std::to_array<EnumName<Padding::Kind>>(
      {{Padding::Kind::valid, "valid"}, {Padding::Kind::same, "same"}, {Padding::Kind::explicit_, "explicit"}});
}

/// Sizes of windows, strides and paddings are below this, so that their sums do not overflow.
constexpr Index kLargestWindow = Index{1} << 31;

/// A window that moves over images x (N, H, W, C) and gives outputs (N, OH, OW, …): what convolution and pooling share.
/// The window of output (oh, ow) covers rows oh·stride_h − top + [0, kh) and columns ow·stride_w − left + [0, kw).
struct Window {
  Index n, h, w, c;
  Index kh, kw, stride_h, stride_w;
  Index top, left;
  Index oh, ow;

  Index positions() const { return n * oh * ow; }
  /// The output columns whose windows lie between the left and the right border of the image.
  struct Columns {
    Index first, last;  // [first, last), may be empty
  };
  Columns inner_columns() const;
  /// The window of the convolution that computes the input gradient (N, H, W, C) from dy (N, OH, OW, K), with weights
  /// flipped along both axes. Requires strides of 1.
  Window input_gradient(Index output_channels) const;
  /// Whether each window is one pixel, in the order of the image: the matrix of windows is the image itself.
  bool reads_in_place() const {
    return kh == 1 && kw == 1 && stride_h == 1 && stride_w == 1 && top == 0 && left == 0 && oh == h && ow == w;
  }
};

/// A window before the size of the image is known.
struct WindowOptions {
  Index kh = 1, kw = 1, stride_h = 1, stride_w = 1;
  Padding padding{};
};

/// Throws Error, prefixed by [operation], if a size other than n is not positive or the window does not fit the padded
/// image.
Window window_over(const char* operation, Index n, Index h, Index w, Index c, const WindowOptions& options);

}  // namespace svnet
