#include "nn/ops/pooling.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "nn/kernels/pool/pool.h"
#include "nn/numbers.h"

using namespace svnet;
using namespace svnet::test;

namespace {

/// Calls body(output offset, input offset) for each pixel of each window, by the definition.
template <class Body>
void for_pixels(const Window& v, Body&& body) {
  for (Index to = 0; to < v.positions() * v.c; ++to) {
    const Index c = to % v.c, ow = to / v.c % v.ow, oh = to / v.c / v.ow % v.oh, n = to / v.c / v.ow / v.oh;
    for (Index row = 0; row < v.h; ++row)
      for (Index column = 0; column < v.w; ++column) {
        const Index down = row + v.top - oh * v.stride_h, across = column + v.left - ow * v.stride_w;
        if (down >= 0 && down < v.kh && across >= 0 && across < v.kw)
          body(to, ((n * v.h + row) * v.w + column) * v.c + c);
      }
  }
}

template <class T>
void check_pooling(const Shape& image, const WindowOptions& options) {
  const Window v = window_over("pool", image[0], image[1], image[2], image[3], options);
  const Tensor x = random_tensor(image, 1, kDType<T>, -3, -1);  // negative: a zero from the border would win
  const Tensor dy = random_tensor({v.n, v.oh, v.ow, v.c}, 2, kDType<T>);
  const auto size = static_cast<std::size_t>(dy.size());
  std::vector<double> sum(size, 0), count(size, 0);
  std::vector<std::int64_t> best(size, -1), source(size, -2);
  for_pixels(v, [&](Index to, Index from) {
    const auto i = static_cast<std::size_t>(to);
    sum[i] += static_cast<double>(x.data<T>()[from]);
    ++count[i];
    if (best[i] < 0 || x.data<T>()[from] > x.data<T>()[best[i]]) best[i] = from;
  });
  INFO(to_string(image) << ", kernel " << v.kh << "x" << v.kw << ", stride " << v.stride_h << "x" << v.stride_w
                        << ", border " << v.top << " " << v.left << ", " << name_of(kDType<T>));
  Parallel& parallel = Parallel::shared();
  Tensor y = Tensor::full(dy.shape(), 7, kDType<T>), dx = Tensor::full(image, 7, kDType<T>);
  kernels::max_pool(parallel, v, x.data<T>(), y.data<T>(), source.data());
  CHECK(source == best);
  for (std::size_t i = 0; i < size; ++i) CHECK(y.values<T>()[i] == (best[i] < 0 ? T{0} : x.data<T>()[best[i]]));
  kernels::max_pool_gradient(parallel, v, dy.data<T>(), source.data(), dx.data<T>());
  Tensor truth = Tensor::zeros(image, DType::f64), magnitude = truth.clone();
  for (std::size_t i = 0; i < size; ++i)
    if (best[i] >= 0) {
      truth.data<double>()[best[i]] += static_cast<double>(dy.values<T>()[i]);
      magnitude.data<double>()[best[i]] += std::abs(static_cast<double>(dy.values<T>()[i]));
    }
  CHECK(error_in_epsilons(dx, truth, magnitude) <= 4);

  kernels::average_pool(parallel, v, x.data<T>(), y.data<T>());
  Tensor mean = Tensor::zeros(y.shape(), DType::f64);
  for (std::size_t i = 0; i < size; ++i)
    if (count[i] > 0) mean.data<double>()[i] = sum[i] / count[i];
  CHECK(error_in_epsilons(y, mean, absolute(mean)) <= 4);
  kernels::average_pool_gradient(parallel, v, dy.data<T>(), dx.data<T>());
  truth = Tensor::zeros(image, DType::f64), magnitude = truth.clone();
  for_pixels(v, [&](Index to, Index from) {
    const double part = static_cast<double>(dy.data<T>()[to]) / count[static_cast<std::size_t>(to)];
    truth.data<double>()[from] += part;
    magnitude.data<double>()[from] += std::abs(part);
  });
  CHECK(error_in_epsilons(dx, truth, magnitude) <= 4);
}

}  // namespace

TEST_CASE("pooling and its gradients follow the definition") {
  for (auto [kh, kw] : {std::pair<Index, Index>{1, 1}, {2, 2}, {3, 3}, {2, 4}, {7, 5}})
    for (auto [stride_h, stride_w] : {std::pair<Index, Index>{1, 1}, {2, 2}, {2, 3}})
      for (const Padding& padding :
           {Padding::valid(), Padding::same(), Padding::of(1, 0, 2, 1), Padding::of(8, 2, 3, 9)}) {
        check_pooling<float>({2, 7, 5, 3}, {kh, kw, stride_h, stride_w, padding});
        check_pooling<double>({2, 7, 5, 3}, {kh, kw, stride_h, stride_w, padding});
      }
}

TEST_CASE("the first of equal maxima receives the gradient") {
  const Window v = window_over("pool", 1, 2, 2, 1, {.kh = 2, .kw = 2});
  const float x[] = {1, 3, 3, 3};
  float y;
  std::int64_t source;
  kernels::max_pool<float>(Parallel::shared(), v, x, &y, &source);
  CHECK(y == 3);
  CHECK(source == 1);
}

TEST_CASE("NaN anywhere in a window passes through pooling") {
  for (Index at = 0; at < 9; ++at) {
    Tensor x = random_tensor({1, 3, 3, 1}, 1, DType::f32);
    x.data<float>()[at] = std::numeric_limits<float>::quiet_NaN();
    INFO("pixel " << at);
    CHECK(std::isnan(ops::global_max_pool2d(x).item()));
    CHECK(std::isnan(ops::global_average_pool2d(x).item()));
  }
}

TEST_CASE("global pooling gives one value per image and channel") {
  const Tensor x = Tensor::from<float>({2, 1, 2, 2}, {1, -5, 3, -7, 10, 20, 30, 60});
  const auto average = ops::global_average_pool2d(x), largest = ops::global_max_pool2d(x);
  CHECK(same_bits(average, Tensor::from<float>({2, 2}, {2, -6, 20, 40})));
  CHECK(same_bits(largest, Tensor::from<float>({2, 2}, {3, -5, 30, 60})));
}
