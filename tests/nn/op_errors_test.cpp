// The messages of operations for shapes, element types or values that do not fit.
#include <catch2/catch.hpp>

#include "nn/ops/activations.h"
#include "nn/ops/batch_norm.h"
#include "nn/ops/conv2d.h"
#include "nn/ops/dense.h"
#include "nn/ops/losses.h"
#include "nn/ops/multiply.h"
#include "nn/ops/pooling.h"
#include "nn/ops/shaping.h"

using namespace svnet;

namespace {

Tensor zeros(const Shape& shape) { return Tensor::zeros(shape); }

}  // namespace

TEST_CASE("convolutions say what does not fit") {
  CHECK_THROWS_WITH(ops::conv2d(zeros({8, 32, 32, 4}), zeros({3, 3, 3, 16}), {}),
                    "[conv2d] input has 4 channels, weight expects 3 (8x32x32x4 * 3x3x3x16)");
  CHECK_THROWS_WITH(ops::depthwise_conv2d(zeros({8, 32, 32, 4}), zeros({3, 3, 3, 1}), {}),
                    "[depthwise_conv2d] input has 4 channels, weight expects 3 (8x32x32x4 * 3x3x3x1)");
  CHECK_THROWS_WITH(ops::separable_conv2d(zeros({8, 9, 9, 4}), zeros({3, 3, 4, 2}), zeros({1, 1, 4, 5}), {}),
                    "[conv2d] input has 8 channels, weight expects 4 (8x7x7x8 * 1x1x4x5)");
  CHECK_THROWS_WITH(ops::conv2d(zeros({32, 32, 3}), zeros({3, 3, 3, 16}), {}),
                    "[conv2d] expects images NxHxWxC and a weight of rank 4, got 32x32x3 * 3x3x3x16");
  CHECK_THROWS_WITH(ops::conv2d(zeros({1, 2, 9, 3}), zeros({3, 3, 3, 16}), {}),
                    "[conv2d] a window of height 3 does not fit an image of height 2 with padding 0 and 0");
  CHECK_THROWS_WITH(ops::conv2d(zeros({1, 9, 2, 3}), zeros({3, 6, 3, 16}), {.padding = Padding::of(0, 0, 1, 2)}),
                    "[conv2d] a window of width 6 does not fit an image of width 2 with padding 1 and 2");
  CHECK_THROWS_WITH(ops::conv2d(zeros({1, 9, 9, 3}), zeros({3, 3, 3, 16}), {.stride_h = 0}),
                    "[conv2d] kernel 3 and stride 0 along the height must be positive");
  CHECK_THROWS_WITH(ops::conv2d(zeros({1, 9, 9, 3}), zeros({3, 3, 3, 16}), {.padding = Padding::of(0, 0, -1, 0)}),
                    "[conv2d] padding along the width is negative");
  CHECK_THROWS_WITH(ops::conv2d(zeros({1, 9, 9, 3}).to(DType::f64), zeros({3, 3, 3, 16}), {}),
                    "[conv2d] operands mix f64 and f32");
  CHECK_THROWS_WITH(ops::conv2d({}, zeros({3, 3, 3, 16}), {}), "[conv2d] an operand is an empty tensor");
}

TEST_CASE("pooling says what does not fit") {
  CHECK_THROWS_WITH(ops::max_pool2d(zeros({2, 3}), {}), "[max_pool2d] expects images NxHxWxC, got 2x3");
  CHECK_THROWS_WITH(ops::average_pool2d(zeros({1, 2, 2, 1}), {.kh = 3, .kw = 1}),
                    "[average_pool2d] a window of height 3 does not fit an image of height 2 with padding 0 and 0");
  CHECK_THROWS_WITH(ops::max_pool2d(zeros({1, 0, 2, 1}), {.padding = Padding::same()}),
                    "[max_pool2d] images of 1x0x2x1 are empty");
  CHECK_THROWS_WITH(ops::global_max_pool2d(zeros({2, 3})), "[global_max_pool2d] expects images NxHxWxC, got 2x3");
  CHECK_THROWS_WITH(ops::global_average_pool2d({}), "[global_average_pool2d] an operand is an empty tensor");
}

TEST_CASE("products say what does not fit") {
  CHECK_THROWS_WITH(ops::multiply(zeros({2, 4, 5, 3}), zeros({2, 4, 1, 3})),
                    "[multiply] expects one shape, or NxHxWxC and Nx1x1xC or NxC, got 2x4x5x3 * 2x4x1x3");
  CHECK_THROWS_WITH(ops::multiply(zeros({2, 4, 5, 3}), zeros({1, 3})), Catch::Contains("got 2x4x5x3 * 1x3"));
  CHECK_THROWS_WITH(ops::multiply(zeros({2, 3}), zeros({2, 3}).to(DType::f64)), "[multiply] operands mix f32 and f64");
}

TEST_CASE("dense layers and batch norm say what does not fit") {
  CHECK_THROWS_WITH(ops::dense(zeros({4, 5}), zeros({6, 2})),
                    "[dense] input has 5 features, weight expects 6 (4x5 * 6x2)");
  CHECK_THROWS_WITH(ops::dense(zeros({4, 5, 1}), zeros({5, 2})),
                    "[dense] expects rows MxC and a weight CxK, got 4x5x1 * 5x2");
  CHECK_THROWS_WITH(ops::bias_add(zeros({4, 5}), zeros({4})), "[bias_add] input has 5 channels, bias has 4");
  Tensor mean = zeros({5}), variance = zeros({5}), short_mean = zeros({4});
  const Tensor five = zeros({5});
  CHECK_THROWS_WITH(ops::batch_norm_training(zeros({1, 5}), five, five, mean, variance, {}),
                    "[batch_norm] training needs at least 2 values per channel, got 1x5");
  CHECK_THROWS_WITH(ops::batch_norm_training(zeros({3, 5}), five, five, short_mean, variance, {}),
                    "[batch_norm] input has 5 channels, a parameter has 4");
  CHECK_THROWS_WITH(ops::batch_norm_inference(zeros({3, 5}), zeros({1, 5}), five, five, five, 0),
                    "[batch_norm] input has 5 channels, a parameter has 1x5");
}

TEST_CASE("shaping says what does not fit") {
  CHECK_THROWS_WITH(ops::reshape(zeros({4, 5}), {3, 7}), "[tensor] cannot reshape 4x5 to 3x7");
  CHECK_THROWS_WITH(ops::flatten(zeros({})), "[flatten] expects at least one axis");
  CHECK_THROWS_WITH(ops::add({}), "[add] needs at least one input");
  CHECK_THROWS_WITH(ops::add({zeros({2, 3}), zeros({3, 2})}), "[add] shapes differ: 2x3 and 3x2");
  CHECK_THROWS_WITH(ops::concat({}), "[concat] needs at least one input");
  CHECK_THROWS_WITH(ops::concat({zeros({2, 3}), zeros({3, 3})}),
                    "[concat] shapes differ before the last axis: 2x3 and 3x3");
  CHECK_THROWS_WITH(ops::concat({zeros({2, 3}), zeros({2})}), "[concat] shapes differ before the last axis: 2x3 and 2");
  CHECK_THROWS_WITH(ops::zero_padding2d(zeros({1, 2, 2, 1}), Padding::same()),
                    "[zero_padding2d] needs four numbers of zeros, none negative");
}

TEST_CASE("losses and softmax say what does not fit") {
  CHECK_THROWS_WITH(ops::mean_squared_error(zeros({4, 1}), zeros({4})),
                    "[mean_squared_error] shapes differ or are empty: 4x1 and 4");
  CHECK_THROWS_WITH(ops::softmax_cross_entropy(zeros({4, 3}), {0, 1}),
                    "[softmax_cross_entropy] expects logits MxK and M classes, got 4x3 and 2");
  CHECK_THROWS_WITH(ops::softmax_cross_entropy(zeros({2, 3}), {0, 3}),
                    "[softmax_cross_entropy] class 3 is outside [0, 3)");
  CHECK_THROWS_WITH(ops::softmax(zeros({})), "[softmax] expects at least one axis that is not empty, got scalar");
}

TEST_CASE("a batch of no images keeps its shape") {
  const Tensor x = ops::conv2d(zeros({0, 5, 5, 3}), zeros({3, 3, 3, 4}), {});
  CHECK(x.shape() == Shape{0, 3, 3, 4});
  CHECK(ops::flatten(x).shape() == Shape{0, 36});
  CHECK(ops::dense(ops::flatten(x), zeros({36, 2})).shape() == Shape{0, 2});
}
