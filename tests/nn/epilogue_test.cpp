#include "nn/kernels/epilogue.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "nn/autograd.h"
#include "nn/instruction_sets.h"
#include "nn/numbers.h"
#include "nn/ops/activations.h"
#include "nn/ops/conv2d.h"
#include "nn/ops/dense.h"

using namespace svnet;
using namespace svnet::test;
using kernels::Clamp;
using kernels::Epilogue;

namespace {

constexpr Clamp kClamps[] = {Clamp::none, Clamp::relu, Clamp::relu6};

Tensor clamped(const Tensor& x, Clamp clamp) {
  return clamp == Clamp::none ? x : clamp == Clamp::relu ? ops::relu(x) : ops::relu6(x);
}

}  // namespace

TEST_CASE("epilogues add the bias and clamp for every number of columns, on every instruction set") {
  for_instruction_sets([](const std::string& name) {
    INFO(name);
    for (Clamp clamp : kClamps)
      for (Index columns = 1; columns <= 70; ++columns) {
        const Index stride = columns + 3;
        const Tensor x = random_tensor({4, stride}, 1, DType::f32, -9, 9),
                     bias = random_tensor({columns}, 2, DType::f32);
        for (const float* b : {static_cast<const float*>(nullptr), bias.data<float>()}) {
          Tensor truth = x.clone(), fast = x.clone(), reference = x.clone();
          for (Index row = 0; row < 4; ++row)
            for (Index c = 0; c < columns; ++c) {
              float& value = truth.data<float>()[row * stride + c];
              if (b != nullptr) value += b[c];
              if (clamp != Clamp::none) value = std::max(value, 0.0f);
              if (clamp == Clamp::relu6) value = std::min(value, 6.0f);
            }
          const Epilogue<float> epilogue{b, clamp};
          kernels::apply(epilogue, 4, columns, stride, fast.data<float>());
          kernels::apply_reference(epilogue, 4, columns, stride, reference.data<float>());
          INFO(columns << " columns, clamp " << static_cast<int>(clamp) << (b != nullptr ? ", bias" : ""));
          CHECK(same_bits(fast, truth));  // the numbers between the rows included
          CHECK(same_bits(reference, truth));
        }
      }
  });
}

TEST_CASE("NaN passes through epilogues at every column, on every instruction set") {
  for_instruction_sets([](const std::string& name) {
    INFO(name);
    const Tensor bias = Tensor::full({39}, 1);
    for (Clamp clamp : kClamps) {
      Tensor fast = Tensor::full({39}, std::numeric_limits<double>::quiet_NaN()), reference = fast.clone();
      kernels::apply(Epilogue<float>{bias.data<float>(), clamp}, 1, 39, 39, fast.data<float>());
      kernels::apply_reference(Epilogue<float>{bias.data<float>(), clamp}, 1, 39, 39, reference.data<float>());
      for (Index c = 0; c < 39; ++c) {
        INFO("clamp " << static_cast<int>(clamp) << ", column " << c);
        CHECK(std::isnan(fast.data<float>()[c]));
        CHECK(std::isnan(reference.data<float>()[c]));
      }
    }
  });
}

TEST_CASE("convolutions with an epilogue give the bits of the operations one after the other") {
  const ops::ConvOptions same{.padding = Padding::same()};
  for (DType dtype : {DType::f32, DType::f64})
    for (Clamp clamp : kClamps)
      for (bool with_bias : {false, true})
        for (Index kernel : {1, 3}) {
          INFO(name_of(dtype) << ", clamp " << static_cast<int>(clamp) << ", bias " << with_bias << ", kernel "
                              << kernel);
          const auto finished = [&](const Tensor& y, const Tensor& bias) {
            return clamped(with_bias ? ops::bias_add(y, bias) : y, clamp);
          };
          // 25 x 27 images make more than one tile of rows, 7 x 5 ones in place one of rows and two of columns.
          for (const Shape& image : {Shape{1, 25, 27, 5}, Shape{1, 7, 5, 5}}) {
            const Tensor x = random_tensor(image, 1, dtype, -5, 5);
            const Tensor w = random_tensor({kernel, kernel, 5, 70}, 2, dtype), bias = random_tensor({70}, 3, dtype);
            const ops::ConvEpilogue epilogue{.bias = with_bias ? bias : Tensor{}, .clamp = clamp};
            CHECK(same_bits(ops::conv2d_inference(x, w, same, epilogue), finished(ops::conv2d(x, w, same), bias)));
          }
          for (Index multiplier : {1, 2}) {
            const Tensor x = random_tensor({2, 9, 7, 37}, 4, dtype, -5, 5);
            const Tensor w = random_tensor({kernel, kernel, 37, multiplier}, 5, dtype);
            const Tensor bias = random_tensor({37 * multiplier}, 6, dtype);
            const ops::ConvEpilogue epilogue{.bias = with_bias ? bias : Tensor{}, .clamp = clamp};
            CHECK(same_bits(ops::depthwise_conv2d_inference(x, w, same, epilogue),
                            finished(ops::depthwise_conv2d(x, w, same), bias)));
          }
        }
}

TEST_CASE("a bias that does not fit a convolution is refused, and nothing is recorded") {
  const Tensor x = Tensor::zeros({1, 5, 5, 2}), w = Tensor::zeros({3, 3, 2, 4}).as_parameter();
  CHECK_THROWS_WITH(ops::conv2d_inference(x, w, {}, {.bias = Tensor::zeros({3})}),
                    "[conv2d] output has 4 channels, bias has 3");
  CHECK_THROWS_WITH(ops::depthwise_conv2d_inference(x, w, {}, {.bias = Tensor::zeros({4})}),
                    "[depthwise_conv2d] output has 8 channels, bias has 4");
  CHECK_FALSE(ops::conv2d_inference(x, w, {}, {}).wants_gradient());
}
