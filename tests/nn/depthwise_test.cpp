#include "nn/kernels/depthwise/depthwise.h"

#include <catch2/catch.hpp>

#include "base/instruction_sets.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;
using kernels::DepthwiseShape;

namespace {

struct Sums {
  Tensor y, dx, dw;
};

/// The definition in f64: every tap of every output that is inside the image.
Sums definition(const DepthwiseShape& s, const Tensor& x, const Tensor& w, const Tensor& dy) {
  const Window& v = s.window;
  Sums sums{Tensor::zeros(dy.shape(), DType::f64), Tensor::zeros(x.shape(), DType::f64),
            Tensor::zeros(w.shape(), DType::f64)};
  for (Index to = 0; to < dy.size(); ++to) {
    const Index channel = to % (v.c * s.multiplier), position = to / (v.c * s.multiplier);
    const Index c = channel / s.multiplier, ow = position % v.ow, oh = position / v.ow % v.oh,
                n = position / (v.ow * v.oh);
    for (Index kh = 0; kh < v.kh; ++kh)
      for (Index kw = 0; kw < v.kw; ++kw) {
        const Index row = oh * v.stride_h + kh - v.top, column = ow * v.stride_w + kw - v.left;
        if (row < 0 || row >= v.h || column < 0 || column >= v.w) continue;
        const Index from = ((n * v.h + row) * v.w + column) * v.c + c,
                    weight = (kh * v.kw + kw) * v.c * s.multiplier + channel;
        sums.y.data<double>()[to] += x.data<double>()[from] * w.data<double>()[weight];
        sums.dx.data<double>()[from] += dy.data<double>()[to] * w.data<double>()[weight];
        sums.dw.data<double>()[weight] += x.data<double>()[from] * dy.data<double>()[to];
      }
  }
  return sums;
}

template <class T>
void check_depthwise(const Shape& image, Index multiplier, const WindowOptions& options) {
  const DepthwiseShape s{window_over("depthwise", image[0], image[1], image[2], image[3], options), multiplier};
  const Window& v = s.window;
  const Tensor x = random_tensor(image, 1, kDType<T>), w = random_tensor({v.kh, v.kw, v.c, multiplier}, 2, kDType<T>);
  const Tensor dy = random_tensor({v.n, v.oh, v.ow, v.c * multiplier}, 3, kDType<T>);
  const Tensor wide_x = x.to(DType::f64), wide_w = w.to(DType::f64), wide_dy = dy.to(DType::f64);
  const Sums truth = definition(s, wide_x, wide_w, wide_dy);
  const Sums size = definition(s, absolute(wide_x), absolute(wide_w), absolute(wide_dy));
  INFO(to_string(image) << " * " << to_string(w.shape()) << ", stride " << v.stride_h << "x" << v.stride_w
                        << ", border " << v.top << " " << v.left << ", " << name_of(kDType<T>));
  Parallel& parallel = Parallel::shared();
  Tensor y = Tensor::full(dy.shape(), 7, kDType<T>), dx = Tensor::full(image, 7, kDType<T>),
         dw = Tensor::full(w.shape(), 7, kDType<T>);
  kernels::depthwise(parallel, s, x.data<T>(), w.data<T>(), y.data<T>());
  CHECK(error_in_epsilons(y, truth.y, size.y) <= 4);
  y = Tensor::full(dy.shape(), 7, kDType<T>);
  kernels::depthwise_reference(parallel, s, x.data<T>(), w.data<T>(), y.data<T>());
  CHECK(error_in_epsilons(y, truth.y, size.y) <= 4);
  kernels::depthwise_input_gradient(parallel, s, dy.data<T>(), w.data<T>(), dx.data<T>());
  CHECK(error_in_epsilons(dx, truth.dx, size.dx) <= 4);
  kernels::depthwise_weight_gradient(parallel, s, x.data<T>(), dy.data<T>(), dw.data<T>());
  CHECK(error_in_epsilons(dw, truth.dw, size.dw) <= 4);
  dx = Tensor::full(image, 7, kDType<T>), dw = Tensor::full(w.shape(), 7, kDType<T>);
  kernels::depthwise_input_gradient_reference(parallel, s, dy.data<T>(), w.data<T>(), dx.data<T>());
  CHECK(error_in_epsilons(dx, truth.dx, size.dx) <= 4);
  kernels::depthwise_weight_gradient_reference(parallel, s, x.data<T>(), dy.data<T>(), dw.data<T>());
  CHECK(error_in_epsilons(dw, truth.dw, size.dw) <= 4);
}

}  // namespace

TEST_CASE("depthwise convolution follows the definition for every number of channels, on every instruction set") {
  for_instruction_sets([](const std::string& name) {
    INFO(name);
    for (Index channels = 1; channels <= 70; ++channels)
      check_depthwise<float>({1, 4, 5, channels}, 1, {3, 3, 1, 1, Padding::same()});
  });
}

TEST_CASE("depthwise convolution follows the definition at odd windows, on every instruction set") {
  for_instruction_sets([](const std::string& name) {
    INFO(name);
    for (Index multiplier : {1, 2, 3})
      for (auto [kh, kw] : {std::pair<Index, Index>{1, 1}, {3, 3}, {2, 4}, {5, 3}})
        for (auto [stride_h, stride_w] : {std::pair<Index, Index>{1, 1}, {2, 2}, {2, 3}})
          for (const Padding& padding :
               {Padding::valid(), Padding::same(), Padding::of(1, 0, 2, 1), Padding::of(6, 7, 8, 5)}) {
            check_depthwise<float>({2, 7, 5, 37}, multiplier, {kh, kw, stride_h, stride_w, padding});
          }
  });
  check_depthwise<double>({2, 7, 5, 3}, 2, {3, 3, 2, 1, Padding::same()});
  check_depthwise<double>({5, 67, 3, 2}, 1, {3, 3, 1, 1, Padding::same()});  // many runs of rows in the weight gradient
}

TEST_CASE("NaN passes through the depthwise convolution at every channel, on every instruction set") {
  for_instruction_sets([](const std::string& name) {
    INFO(name);
    const DepthwiseShape s{window_over("depthwise", 1, 1, 1, 39, {}), 1};
    const Tensor x = Tensor::full({39}, std::numeric_limits<float>::quiet_NaN()), w = Tensor::zeros({39});
    Tensor y = Tensor::zeros({39});
    kernels::depthwise(Parallel::shared(), s, x.data<float>(), w.data<float>(), y.data<float>());
    for (float value : y.values<float>()) CHECK(std::isnan(value));
  });
}
