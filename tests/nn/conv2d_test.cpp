#include "nn/kernels/conv2d/conv2d.h"

#include <catch2/catch.hpp>
#include <tuple>

#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;
using kernels::Conv2dShape;

namespace {

struct Sums {
  Tensor y, dx, dw;
};

/// The definition in f64 on a padded image: y = Σ x·w, dx = Σ dy·w, dw = Σ x·dy.
Sums definition(const Conv2dShape& s, const Tensor& x, const Tensor& w, const Tensor& dy) {
  const Window& v = s.window;
  const Index height = (v.oh - 1) * v.stride_h + v.kh + v.h,
              width = (v.ow - 1) * v.stride_w + v.kw + v.w;  // large enough
  Tensor framed = Tensor::zeros({v.n, height, width, v.c}, DType::f64), framed_gradient = framed.clone();
  const auto at = [&](Index n, Index h, Index column, Index c) {
    return ((n * height + h) * width + column) * v.c + c;
  };
  const auto for_image = [&](auto&& body) {
    for (Index n = 0; n < v.n; ++n)
      for (Index h = 0; h < v.h; ++h)
        for (Index column = 0; column < v.w; ++column)
          for (Index c = 0; c < v.c; ++c)
            body(((n * v.h + h) * v.w + column) * v.c + c, at(n, h + v.top, column + v.left, c));
  };
  for_image([&](Index i, Index framed_at) { framed.data<double>()[framed_at] = x.data<double>()[i]; });
  Sums sums{Tensor::zeros(dy.shape(), DType::f64), Tensor::empty(x.shape(), DType::f64),
            Tensor::zeros(w.shape(), DType::f64)};
  for (Index n = 0; n < v.n; ++n)
    for (Index oh = 0; oh < v.oh; ++oh)
      for (Index ow = 0; ow < v.ow; ++ow)
        for (Index k = 0; k < s.k; ++k)
          for (Index kh = 0; kh < v.kh; ++kh)
            for (Index kw = 0; kw < v.kw; ++kw)
              for (Index c = 0; c < v.c; ++c) {
                const Index from = at(n, oh * v.stride_h + kh, ow * v.stride_w + kw, c);
                const Index weight = ((kh * v.kw + kw) * v.c + c) * s.k + k,
                            to = ((n * v.oh + oh) * v.ow + ow) * s.k + k;
                sums.y.data<double>()[to] += framed.data<double>()[from] * w.data<double>()[weight];
                framed_gradient.data<double>()[from] += dy.data<double>()[to] * w.data<double>()[weight];
                sums.dw.data<double>()[weight] += framed.data<double>()[from] * dy.data<double>()[to];
              }
  for_image([&](Index i, Index framed_at) { sums.dx.data<double>()[i] = framed_gradient.data<double>()[framed_at]; });
  return sums;
}

template <class T>
void check_convolution(const Conv2dShape& s) {
  const Window& v = s.window;
  const Tensor x = random_tensor({v.n, v.h, v.w, v.c}, 1, kDType<T>),
               w = random_tensor({v.kh, v.kw, v.c, s.k}, 2, kDType<T>);
  const Tensor dy = random_tensor({v.n, v.oh, v.ow, s.k}, 3, kDType<T>);
  const Tensor wide_x = x.to(DType::f64), wide_w = w.to(DType::f64), wide_dy = dy.to(DType::f64);
  const Sums truth = definition(s, wide_x, wide_w, wide_dy);
  const Sums size = definition(s, absolute(wide_x), absolute(wide_w), absolute(wide_dy));
  INFO(to_string(x.shape()) << " * " << to_string(w.shape()) << ", stride " << v.stride_h << "x" << v.stride_w
                            << ", border " << v.top << " " << v.left << ", " << name_of(kDType<T>));
  // The previous contents must not matter.
  Tensor y = Tensor::full(dy.shape(), 7, kDType<T>), dx = Tensor::full(x.shape(), 7, kDType<T>),
         dw = Tensor::full(w.shape(), 7, kDType<T>);
  const auto check_all = [&] {
    CHECK(error_in_epsilons(y, truth.y, size.y) <= 4);
    CHECK(error_in_epsilons(dx, truth.dx, size.dx) <= 4);
    CHECK(error_in_epsilons(dw, truth.dw, size.dw) <= 4);
  };
  Parallel& parallel = Parallel::shared();
  kernels::conv2d(parallel, s, x.data<T>(), w.data<T>(), y.data<T>());
  kernels::conv2d_input_gradient(parallel, s, dy.data<T>(), w.data<T>(), dx.data<T>());
  kernels::conv2d_weight_gradient(parallel, s, x.data<T>(), dy.data<T>(), dw.data<T>());
  check_all();
  kernels::conv2d_reference(s, x.data<T>(), w.data<T>(), y.data<T>());
  kernels::conv2d_input_gradient_reference(s, dy.data<T>(), w.data<T>(), dx.data<T>());
  kernels::conv2d_weight_gradient_reference(s, x.data<T>(), dy.data<T>(), dw.data<T>());
  check_all();
}

void check_both(const Shape& image, Index k, const WindowOptions& options) {
  const Conv2dShape s{window_over("conv2d", image[0], image[1], image[2], image[3], options), k};
  check_convolution<float>(s);
  check_convolution<double>(s);
}

}  // namespace

TEST_CASE("convolution and its gradients follow the definition at odd sizes") {
  for (auto [kh, kw] : {std::pair<Index, Index>{1, 1}, {3, 3}, {2, 4}, {5, 3}})
    for (auto [stride_h, stride_w] : {std::pair<Index, Index>{1, 1}, {2, 2}, {2, 3}})
      for (const Padding& padding :
           {Padding::valid(), Padding::same(), Padding::of(1, 0, 2, 1), Padding::of(4, 5, 0, 6)})
        check_both({2, 7, 5, 3}, 4, {kh, kw, stride_h, stride_w, padding});
}

TEST_CASE("convolution over more than one tile of positions") {
  check_both({2, 29, 31, 2}, 3, {3, 3, 1, 1, Padding::same()});   // 1798 positions, tiles of 512
  check_both({1, 25, 27, 5}, 66, {1, 1, 1, 1, Padding::same()});  // in place, more than 384 rows
  check_both({1, 7, 9, 1025}, 2, {3, 3, 1, 1, Padding::same()});  // tiles of 16
}

TEST_CASE("the weight gradient of no images is zero") {
  for (Index kernel : {1, 3}) {
    const Conv2dShape s{window_over("conv2d", 0, 5, 5, 2, {.kh = kernel, .kw = kernel}), 3};
    Tensor dw = Tensor::full({kernel, kernel, 2, 3}, 7);
    kernels::conv2d_weight_gradient<float>(Parallel::shared(), s, nullptr, nullptr, dw.data<float>());
    CHECK(same_bits(dw, Tensor::zeros(dw.shape())));
  }
}

TEST_CASE("padding 'same' puts the odd zero at the bottom and right, as in Keras") {
  const auto border = [](Index size, Index kernel, Index stride) {
    const Window w = window_over("conv2d", 1, size, size, 1, {kernel, kernel, stride, stride, Padding::same()});
    CHECK(w.top == w.left);
    CHECK(w.oh == w.ow);
    return std::pair{w.top, w.oh};
  };
  CHECK(border(5, 3, 1) == std::pair<Index, Index>{1, 5});
  CHECK(border(5, 3, 2) == std::pair<Index, Index>{1, 3});
  CHECK(border(6, 3, 2) == std::pair<Index, Index>{0, 3});
  CHECK(border(5, 2, 1) == std::pair<Index, Index>{0, 5});
  CHECK(border(5, 4, 1) == std::pair<Index, Index>{1, 5});
  CHECK(border(5, 1, 3) == std::pair<Index, Index>{0, 2});
}
