#include "nn/kernels/epilogue.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/instruction_sets.h"
#include "nn/kernels/depthwise/depthwise.h"
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
          CHECK(same_bits(fast, truth));  // including the floats between the rows
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

TEST_CASE("a depthwise convolution with an epilogue gives the bits of the operations one after the other") {
  for (Clamp clamp : kClamps)
    for (bool with_bias : {false, true})
      for (Index multiplier : {1, 2}) {
        INFO("clamp " << static_cast<int>(clamp) << ", bias " << with_bias << ", multiplier " << multiplier);
        const Tensor x = random_tensor({2, 9, 7, 37}, 4, DType::f32, -5, 5);
        const Tensor w = random_tensor({3, 3, 37, multiplier}, 5, DType::f32);
        const Tensor bias = random_tensor({37 * multiplier}, 6, DType::f32);
        const Window window = window_over("test", 2, 9, 7, 37, {.kh = 3, .kw = 3, .padding = Padding::same()});
        Tensor y = Tensor::empty({2, 9, 7, 37 * multiplier});
        kernels::depthwise(Parallel::shared(), {window, multiplier}, x.data<float>(), w.data<float>(), y.data<float>(),
                           Epilogue<float>{with_bias ? bias.data<float>() : nullptr, clamp});
        const Tensor plain = ops::depthwise_conv2d(x, w, {.padding = Padding::same()});
        CHECK(same_bits(y, clamped(with_bias ? ops::bias_add(plain, bias) : plain, clamp)));
      }
}
